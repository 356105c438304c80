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

MeshChange no_change(const Mesh& mesh) {
  MeshChange change;
  change.cell = itself(mesh.cell_count());
  change.face = itself(mesh.face_count());
  change.fracture_cell = itself(mesh.fracture_cell_count());
  change.fracture_point = itself(mesh.fracture_points.size());
  return change;
}

}  // namespace sprekk
