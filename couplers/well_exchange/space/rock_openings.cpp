// In space a well is a line through cells, each of which takes what enters along its piece of the line.
#include "couplers/well_exchange/rock_openings.hpp"

#include <Eigen/Geometry>
#include <Eigen/LU>
#include <algorithm>
#include <cmath>
#include <map>
#include <stdexcept>

#include "couplers/well_exchange/space/line_field.hpp"
#include "couplers/well_exchange/space/line_patch.hpp"
#include "framework/mesh/geometry.hpp"

namespace sprekk::couplers {
namespace {

constexpr double alike = 1e-12;     // of normalized mobilities
constexpr double oblique = 1e-9;    // sine of the angle with a normal
constexpr double at_a_side = 1e-9;  // in lengths of the line

/// The pieces of one line: places from `first` to before `last`.
class LineOfWell {
 public:
  LineOfWell(const Mesh& mesh, const MatrixFluid& rock, const MatrixFluxes& fluxes,
             const std::vector<WellPlace>& places, int first, int last)
      : mesh_(mesh), rock_(rock), fluxes_(fluxes), places_(places), first_(first), last_(last) {
    for (int k = first; k < last; ++k) lengths_[piece(k).cell] += piece(k).length();
  }

  void open(std::vector<RockOpening>& openings) const {
    std::vector<Tensor> done;
    for (int k = first_; k < last_; ++k) {
      if (std::ranges::any_of(done, [&](const Tensor& other) { return has_mobility(k, other); })) continue;
      done.push_back(normalized_mobility(k));
      find(done.back(), openings);
    }
  }

 private:
  const WellPlace::Piece& piece(int k) const { return *places_[k].piece; }
  const WellPlace& place() const { return places_[first_]; }

  Tensor normalized_mobility(int k) const {
    const Tensor& mobility = fluxes_.mobility()[piece(k).cell];
    return mobility / mobility.norm();
  }
  /// Whether the rock around a piece has this mobility, but for a factor.
  bool has_mobility(int k, const Tensor& normalized) const {
    return (normalized_mobility(k) - normalized).norm() < alike;
  }

  [[noreturn]] void refuse(const std::string& why) const {
    throw InputError(place().origin, "the index of well '" + place().name + "' cannot be found", why,
                     "end its line farther from there (where it meets a fracture, open it to that by a place of its "
                     "own), use smaller cells, or give its 'index'");
  }

  /// LineField has images for closed sides only.
  void refuse_what_is_no_closed_side() const {
    for (const auto& [cell, length] : lengths_)
      for (const int node : mesh_.cell_nodes[cell])
        for (const int face : mesh_.node_faces[node]) {
          const int side = mesh_.face_side[face];
          if (side != none && rock_.is_open(side))
            refuse("its cells touch the open side '" + mesh_.side_names[side] + "'");
          for (const int other : mesh_.face_cells[face])
            if (other != none && !rock_.is_in_cell(other)) refuse("its cells touch rock without this flow");
        }
  }

  /// The sides that the cells of the line touch, for which LineField has images.
  std::vector<ClosedPlane> planes(const Tensor& mobility) const {
    const auto [planes, has_fracture] = touched_sides(mesh_, lengths_);
    if (has_fracture) refuse("its cells touch a fracture");
    refuse_what_is_no_closed_side();
    for (const auto& [at, normal] : planes)
      if (normal.cross(mobility * normal).norm() > oblique)
        refuse("its cells touch the side at " + to_text(at) + ", to which the permeability is oblique");
    if (planes.size() < 2) return planes;
    const std::vector<Point>& line = piece(first_).line;
    const Point along = line.back() - line.front();
    const auto ends_at = [&](const ClosedPlane& plane) {
      return std::ranges::any_of(std::vector{line.front(), line.back()}, [&](const Point& end) {
        return std::abs(plane.normal.dot(end - plane.at)) < at_a_side * along.norm();
      });
    };
    const bool is_between =
        planes.size() == 2 && line.size() == 2 && std::ranges::all_of(planes, [&](const ClosedPlane& plane) {
          return ends_at(plane) && plane.normal.cross(along).norm() < oblique * along.norm();
        });
    if (!is_between) refuse("its cells touch several sides, between which it is no straight line at right angles");
    return planes;
  }

  LinePatch patch(const LineField& field, const Tensor& mobility, const std::vector<ClosedPlane>& planes) const {
    try {
      return {mesh_, fluxes_, lengths_, field, mobility, planes};
    } catch (const std::invalid_argument& error) {
      refuse_flow(place(), error.what());
    }
  }

  /// The width of a cell along a direction, m.
  double width(int cell, const Point& direction) const {
    double low = HUGE_VAL, high = -HUGE_VAL;
    for (const int node : mesh_.cell_nodes[cell]) {
      low = std::min(low, direction.dot(mesh_.nodes[node]));
      high = std::max(high, direction.dot(mesh_.nodes[node]));
    }
    return high - low;
  }

  /// The openings of all pieces in rock of this mobility, but for a factor.
  void find(const Tensor& mobility, std::vector<RockOpening>& openings) const {
    const std::vector<ClosedPlane> planes = this->planes(mobility);
    const LineField field(piece(first_).line, mobility, widened_radius(place()), planes);
    const LinePatch patch = this->patch(field, mobility, planes);
    std::map<double, std::vector<double>> transformed;
    const auto transforms = [&](double decay) -> const std::vector<double>& {
      auto& known = transformed[decay];
      if (known.empty()) known = patch.transformed_pressures(decay);
      return known;
    };
    double area = 0;  // one for all pieces, so that all have the same transforms
    for (int k = first_; k < last_; ++k) {
      const auto& [cell, from, to, line] = piece(k);
      area = std::max(area, mesh_.cell_measure[cell] / width(cell, (to - from).normalized()));
    }
    const std::vector<double> steady = patch.pressures();
    for (int k = first_; k < last_; ++k) {
      if (!has_mobility(k, mobility)) continue;
      const auto& [cell, from, to, line] = piece(k);
      const auto row = std::distance(lengths_.begin(), lengths_.find(cell));
      // Pressures are those of 1 m of the first part of the line: that of this part may be another one.
      const double part = mobility_across(places_[k], mobility) / field.mobility();
      const double log_of_radii = part * (field.pressure_at_bore(from, to) - steady[row]);
      openings[k].early = fit_early_terms(log_of_radii, field.bore(), area, [&](double decay) {
        return part * (field.transformed_pressure_at_bore(from, to, decay) - transforms(decay)[row]);
      });
      // Terms have the diffusivity across the first part of the line, and WellExchange that across this one.
      for (double& scale : openings[k].early.scales) scale *= part;
      openings[k].early.log_of_radii += skin_beside_radius(place());
      require_positive_index(places_[k], openings[k].early.log_of_radii, field.bore() * std::exp(log_of_radii));
    }
  }

  const Mesh& mesh_;
  const MatrixFluid& rock_;
  const MatrixFluxes& fluxes_;
  const std::vector<WellPlace>& places_;
  int first_, last_;
  std::map<int, double> lengths_;  ///< of the line in its cells, m
};

}  // namespace

std::vector<RockOpening> rock_openings(const Mesh& mesh, const MatrixFluid& rock, const MatrixFluxes& fluxes,
                                       const std::vector<WellPlace>& places, const std::vector<int>& cells) {
  std::vector<RockOpening> openings(places.size());
  const int count = static_cast<int>(places.size());
  for (int k = 0; k < count; ++k)
    if (cells[k] != none) openings[k].shares = {{cells[k], 1.0}};
  for (int first = 0, last = 0; first < count; first = last) {
    last = first + 1;
    if (!places[first].piece || places[first].index) continue;
    while (last < count && places[last].piece && places[last].name == places[first].name) ++last;
    LineOfWell(mesh, rock, fluxes, places, first, last).open(openings);
  }
  return openings;
}

}  // namespace sprekk::couplers
