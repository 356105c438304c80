// The loads that the fine level takes from the coarse level: displacements on its outline, stress, tractions on walls.
#include <algorithm>

#include "components/fine_fracture/tips/ends.hpp"
#include "components/fine_fracture/tips/tips.hpp"
#include "framework/mesh/plane/planar.hpp"
#include "framework/round_off.hpp"

namespace sprekk::fine_fracture {

namespace {

/// A cell in whose place the fine level has an arc.
struct Arc {
  int fracture;
  double from, to;  ///< m, along the fracture
  Point along;      ///< of the cell
};

/// The vector, turned as the second direction is from the first one.
Point turned(const Point& vector, const Point& from, const Point& to) {
  const double c = from.dot(to), s = cross(from, to);
  return {c * vector[0] - s * vector[1], s * vector[0] + c * vector[1]};
}

}  // namespace

FineLoads Tips::loads_of(const Tip& tip) const {
  std::vector<double> lengths;
  for (int f = 0; f < static_cast<int>(mesh_.fractures.size()); ++f) lengths.push_back(fracture_length(mesh_, f));
  std::vector<Arc> arcs;
  for (const Tip& other : tips_) {
    if (!other.now.segment_start) continue;
    const FractureCell& cell = last_cell(other.end);
    const double from = other.end.at_end ? lengths[other.end.fracture] - cell.measure : 0;
    arcs.push_back({other.end.fracture, from, from + cell.measure, cell.tangents});
  }
  const FineDomain& domain = tip.domain;
  const auto arc = [&domain](int crack, int segment, double s) {
    const std::vector<double>& along = domain.sources[crack].arc;
    return along[segment] + s * (along[segment + 1] - along[segment]);
  };
  FineLoads loads;
  loads.boundary_displacement = [this](const Point& x, const Point& inside) {
    return surroundings_->displacement(x, inside);
  };
  loads.stress_offset = [this, &domain, arcs_now = arcs_of_last_segments()](const std::vector<Point>& places) {
    return surroundings_->stress_offsets(places, arcs_now.on_coarse_level(places, domain.geometry.outline))();
  };
  if (surroundings_->body_forces({}))
    loads.body_force = [this](const std::vector<Point>& places) { return surroundings_->body_forces(places)(); };
  loads.wall_traction = [this, &domain, arc, lengths, arcs](int crack, int segment, double s) -> Point {
    const int fracture = domain.sources[crack].fracture;
    const double at = arc(crack, segment, s);
    // Walls that have grown in the fine level are open, and carry the pressure of the fluid.
    const std::vector<Point>& points = domain.geometry.cracks[crack].points;
    const Point along = (points[segment + 1] - points[segment]).normalized();
    const Point normal(along[1], -along[0]);
    const double middle = arc(crack, segment, 0.5);
    if (middle < 0) return -surroundings_->fluid_pressure(fracture, false) * normal;
    if (middle > lengths[fracture]) return -surroundings_->fluid_pressure(fracture, true) * normal;
    const Point traction = surroundings_->wall_traction(fracture, at);
    // Pieces of an arc have the tractions of the straight cell in their own directions.
    for (const Arc& bent : arcs)
      if (bent.fracture == fracture && middle > bent.from && middle < bent.to)
        return turned(traction, bent.along, along);
    return traction;
  };
  // A fracture that has not kinked keeps the tractions of its cells: they vary little along it.
  std::vector<char> has_kinked;
  for (const FineDomain::Source& source : domain.sources) {
    const Fracture& fracture = mesh_.fractures[source.fracture];
    bool has_grown = source.arc.front() < 0 || source.arc.back() > lengths[source.fracture];
    for (int i = 0; i < fracture.cell_count; ++i)
      has_grown = has_grown || mesh_.fracture_cells[fracture.first_cell + i].grown;
    has_kinked.push_back(has_grown);
  }
  if (std::ranges::count(has_kinked, 1) > 0)
    loads.sliding = [this, &domain, arc, lengths, has_kinked](int crack, int segment,
                                                              double s) -> std::optional<TipSurroundings::Sliding> {
      const int fracture = domain.sources[crack].fracture;
      const double at = arc(crack, segment, s);
      if (!has_kinked[crack] || at < 0 || at > lengths[fracture]) return std::nullopt;
      return surroundings_->sliding(fracture, at);
    };
  // Jumps are asked for at the ends of segments, too. At a junction each segment has its own jump: the place is moved
  // into the segment by a rounding error.
  const double inside = mesh_.junctions.empty() ? 0 : rounding::same;
  loads.wall_jump = [this, &domain, arc, inside](int crack, int segment, double s) {
    return surroundings_->wall_jump(domain.sources[crack].fracture, arc(crack, segment, s + inside * (0.5 - s)));
  };
  loads.jump_beyond = [this, &domain](int path, int segment, double s) {
    const std::vector<double>& along = domain.beyond[path].arc;
    return surroundings_->wall_jump(domain.beyond[path].fracture,
                                    along[segment] + s * (along[segment + 1] - along[segment]));
  };
  return loads;
}

}  // namespace sprekk::fine_fracture
