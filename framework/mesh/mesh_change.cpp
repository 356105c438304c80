#include "framework/mesh/mesh_change.hpp"

#include <numeric>

namespace sprekk {

namespace {

std::vector<int> itself(std::size_t count) {
  std::vector<int> origin(count);
  std::iota(origin.begin(), origin.end(), 0);
  return origin;
}

}  // namespace

Vector covered_parts(const MeshChange& change, const Mesh& after) {
  Vector parts = Vector::Ones(after.fracture_cell_count());
  for (int i = 0; i < after.fracture_cell_count(); ++i)
    if (change.fracture_cell[i] == none) parts[i] = 0;
  for (const ReplacedPart& part : change.replaced_parts)
    parts[part.cell] += part.length / after.fracture_cells[part.cell].measure;
  return parts;
}

MeshChange no_change(const Mesh& mesh) {
  MeshChange change;
  change.cell = itself(mesh.cell_count());
  change.face = itself(mesh.face_count());
  change.fracture_cell = itself(mesh.fracture_cell_count());
  change.ridge = itself(mesh.ridges.size());
  return change;
}

}  // namespace sprekk
