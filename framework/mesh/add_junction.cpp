#include "framework/mesh/add_junction.hpp"

namespace sprekk {

void add_junction(Mesh& mesh, const Ridge& place, const std::vector<RidgeOfCell>& at) {
  const auto are_neighbours = [&](std::size_t i, std::size_t j) {
    return mesh.fracture_cells[at[i].cell].fracture == mesh.fracture_cells[at[j].cell].fracture;
  };
  const auto ridge_at = [&](std::size_t i) -> int& { return mesh.fracture_cells[at[i].cell].ridges[at[i].ridge]; };
  Junction junction;
  for (std::size_t i = 0; i < at.size(); ++i) {
    junction.cells.push_back(at[i].cell);
    const bool has_neighbour = (i > 0 && are_neighbours(i - 1, i)) || (i + 1 < at.size() && are_neighbours(i, i + 1));
    if (!has_neighbour) ridge_at(i) = none;
  }
  for (std::size_t i = 0; i < at.size(); ++i)
    for (std::size_t j = i + 1; j < at.size(); ++j) {
      int ridge = ridge_at(i);
      if (!are_neighbours(i, j)) {
        ridge = static_cast<int>(mesh.ridges.size());
        mesh.ridges.push_back({place.center, place.measure, {at[i].cell, at[j].cell}, Ridge::Kind::junction, none});
      }
      junction.ridges.push_back(ridge);
      if (ridge_at(i) == none) ridge_at(i) = ridge;
      if (ridge_at(j) == none) ridge_at(j) = ridge;
    }
  mesh.junctions.push_back(std::move(junction));
}

}  // namespace sprekk
