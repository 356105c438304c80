#include "framework/mesh/add_junction.hpp"

namespace sprekk {

void add_junction(Mesh& mesh, const Point& position, const std::vector<FractureCellEnd>& ends) {
  const auto fracture_of = [&](const FractureCellEnd& end) { return mesh.fracture_cells[end.cell].fracture; };
  const auto are_neighbours = [&](std::size_t i, std::size_t j) {
    return ends[j].cell == ends[i].cell + 1 && fracture_of(ends[i]) == fracture_of(ends[j]);
  };
  Junction junction;
  for (std::size_t i = 0; i < ends.size(); ++i) {
    junction.cells.push_back(ends[i].cell);
    const bool has_neighbour = (i > 0 && are_neighbours(i - 1, i)) || (i + 1 < ends.size() && are_neighbours(i, i + 1));
    int& own_point = mesh.fracture_cells[ends[i].cell].points[ends[i].end];
    if (!has_neighbour) own_point = none;
  }
  for (std::size_t i = 0; i < ends.size(); ++i) {
    int& own_point = mesh.fracture_cells[ends[i].cell].points[ends[i].end];
    for (std::size_t j = i + 1; j < ends.size(); ++j) {
      int& other_point = mesh.fracture_cells[ends[j].cell].points[ends[j].end];
      int point = own_point;
      if (!are_neighbours(i, j)) {
        point = static_cast<int>(mesh.fracture_points.size());
        mesh.fracture_points.push_back({position, {ends[i].cell, ends[j].cell}, FracturePoint::Kind::junction, none});
      }
      junction.points.push_back(point);
      if (own_point == none) own_point = point;
      if (other_point == none) other_point = point;
    }
  }
  mesh.junctions.push_back(std::move(junction));
}

}  // namespace sprekk
