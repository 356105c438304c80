#include "framework/mesh/fracture_ridges.hpp"

#include <algorithm>
#include <string>

#include "framework/config/input_error.hpp"
#include "framework/mesh/geometry.hpp"
#include "framework/mesh/medium.hpp"

namespace sprekk {

void FractureRidges::add(const RawMesh& raw, int fracture, const std::vector<FaceNodes>& faces,
                         const OuterRidges& outer) {
  for (const FaceNodes& face : faces) {
    const int cell = static_cast<int>(places_of_cell_.size());
    places_of_cell_.push_back(face);  // as many as it has nodes
    for (int k = 0; k < static_cast<int>(face.size()); ++k) {
      const RidgeNodes nodes = ridge_of(face, k);
      const auto [found, is_new] = number_of_.try_emplace(sorted(nodes), static_cast<int>(places_.size()));
      if (is_new) places_.push_back({nodes, {}});
      Place& place = places_[found->second];
      claim(raw, fracture, place, k, outer);
      place.at.push_back({cell, k});
      places_of_cell_.back()[k] = found->second;
    }
  }
}

void FractureRidges::claim(const RawMesh& raw, int fracture, Place& place, int k, const OuterRidges& outer) {
  const std::string& name = raw.fractures[fracture].name;
  const auto where = [&] { return " at " + to_text(ridge_geometry(raw.nodes, place.nodes).center); };
  if (place.fracture == fracture) {
    // Along a chain, the second end of a cell is new.
    if (++place.cells_of_fracture > 2 || (dimension == 2 && k == 1)) {
      throw InputError("fracture '" + name + "' meets itself" + where() +
                       " (loops and branches are not supported) leave a gap or make it two fractures");
    }
    if (outer.has(place.nodes)) {
      throw InputError("fracture '" + name + "' touches the outer boundary" + where() +
                       " (only its ends may lie on the boundary)");
    }
    return;
  }
  if (place.fracture != none) {
    if (outer.has(place.nodes)) {
      throw InputError("fractures '" + raw.fractures[place.fracture].name + "' and '" + name + "' meet" + where() +
                       " (fractures may not meet on the outer boundary) let them meet inside of the " + medium_name());
    }
    place.is_junction = true;
  }
  place.fracture = fracture;
  place.cells_of_fracture = 1;
}

void FractureRidges::add_to(Mesh& mesh, const RawMesh& raw, const OuterRidges& outer) const {
  for (int cell = 0; cell < mesh.fracture_cell_count(); ++cell)
    for (int k = 0; k < static_cast<int>(places_of_cell_[cell].size()); ++k) add_ridge(mesh, raw, {cell, k}, outer);
  // In the order of fractures, so that the result does not depend on how the nodes are numbered.
  std::vector<char> is_done(places_.size(), 0);
  for (const FaceRidges& places : places_of_cell_)
    for (const int number : places) {
      const Place& place = places_[number];
      if (!place.is_junction || is_done[number]) continue;
      is_done[number] = 1;
      const auto [center, measure] = ridge_geometry(raw.nodes, place.nodes);
      add_junction(mesh, {center, measure, {}, Ridge::Kind::junction, none}, place.at);
    }
}

/// The ridge of a cell and the next one of its fracture, if the cell is the first of them.
void FractureRidges::add_ridge(Mesh& mesh, const RawMesh& raw, const RidgeOfCell& first,
                               const OuterRidges& outer) const {
  const Place& place = places_[places_of_cell_[first.cell][first.ridge]];
  const int fracture = mesh.fracture_cells[first.cell].fracture;
  std::vector<RidgeOfCell> own;
  for (const RidgeOfCell& other : place.at)
    if (mesh.fracture_cells[other.cell].fracture == fracture) own.push_back(other);
  if (own.front().cell != first.cell || (place.is_junction && own.size() == 1)) return;
  const bool is_end = own.size() == 1, is_outer = is_end && outer.has(place.nodes);
  using Kind = Ridge::Kind;
  const Kind kind = place.is_junction ? Kind::junction
                    : is_outer        ? Kind::on_boundary
                    : is_end          ? Kind::tip
                                      : Kind::inside;
  const auto [center, measure] = ridge_geometry(raw.nodes, place.nodes);
  std::vector<int> cells;
  for (const RidgeOfCell& other : own) {
    mesh.fracture_cells[other.cell].ridges[other.ridge] = static_cast<int>(mesh.ridges.size());
    cells.push_back(other.cell);
  }
  mesh.ridges.push_back({center, measure, cells, kind, is_outer ? outer.side_of(place.nodes) : none});
}

}  // namespace sprekk
