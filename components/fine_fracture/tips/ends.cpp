#include "components/fine_fracture/tips/ends.hpp"

namespace sprekk::fine_fracture {

const FractureCell& end_cell(const Mesh& mesh, const TipEnd& end) {
  const Fracture& cells = mesh.fractures[end.fracture];
  return mesh.fracture_cells[cells.first_cell + (end.at_end ? cells.cell_count - 1 : 0)];
}

Point end_point(const Mesh& mesh, const TipEnd& end) {
  return mesh.ridges[end_cell(mesh, end).ridges[end.at_end ? 1 : 0]].center;
}

Ridge::Kind kind_of(const Mesh& mesh, const TipEnd& end) {
  return mesh.ridges[end_cell(mesh, end).ridges[end.at_end ? 1 : 0]].kind;
}

std::string name_of(const Mesh& mesh, const TipEnd& end) {
  return mesh.fractures[end.fracture].name + (end.at_end ? "_last" : "_first");
}

std::vector<TipEnd> all_ends(const Mesh& mesh) {
  std::vector<TipEnd> ends;
  for (int f = 0; f < static_cast<int>(mesh.fractures.size()); ++f)
    for (const bool at_end : {false, true}) ends.push_back({f, at_end});
  return ends;
}

double fracture_length(const Mesh& mesh, int fracture) {
  const Fracture& cells = mesh.fractures[fracture];
  double length = 0;
  for (int i = 0; i < cells.cell_count; ++i) length += mesh.fracture_cells[cells.first_cell + i].measure;
  return length;
}

double original_size(const Mesh& mesh, const TipEnd& end) {
  const Fracture& cells = mesh.fractures[end.fracture];
  for (int i = 0; i < cells.cell_count; ++i) {
    const FractureCell& cell = mesh.fracture_cells[cells.first_cell + (end.at_end ? cells.cell_count - 1 - i : i)];
    if (!cell.grown) return cell.measure;
  }
  return end_cell(mesh, end).measure;
}

double new_length(const Mesh& mesh, const TipEnd& end, const MeshChange& change) {
  const Fracture& cells = mesh.fractures[end.fracture];
  double length = 0;
  for (int i = 0; i < cells.cell_count; ++i) {
    const int cell = cells.first_cell + (end.at_end ? cells.cell_count - 1 - i : i);
    if (change.fracture_cell[cell] != none) break;
    length += mesh.fracture_cells[cell].measure;
  }
  return length;
}

double given_up_length(const Mesh& mesh, const TipEnd& end, const MeshChange& change) {
  const Fracture& cells = mesh.fractures[end.fracture];
  double length = 0;
  for (int i = 0; i < cells.cell_count; ++i) {
    const int cell = cells.first_cell + (end.at_end ? cells.cell_count - 1 - i : i);
    if (change.fracture_cell[cell] != none) break;
    for (const ReplacedPart& part : change.replaced_parts)
      if (part.cell == cell) length += part.length;
  }
  return length;
}

double length_of(const Point& from, const TipPath& path) {
  double length = 0;
  Point last = from;
  for (const Point& x : path.added) {
    length += (x - last).norm();
    last = x;
  }
  return length;
}

}  // namespace sprekk::fine_fracture
