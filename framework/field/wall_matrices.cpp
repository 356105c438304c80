#include "framework/field/wall_matrices.hpp"

#include "framework/field/ownership.hpp"
#include "framework/matrix_of.hpp"

namespace sprekk {

SparseMatrix owned_walls_of_faces(const Mesh& mesh) {
  std::vector<Triplet> entries;
  for (int w = 0; w < mesh.wall_count(); ++w)
    if (is_owned(mesh, Location::wall, w)) entries.emplace_back(w, mesh.wall_face(w), 1.0);
  return matrix_of(mesh.wall_count(), mesh.face_count(), entries);
}

SparseMatrix outflow_of_wall_fluxes(const Mesh& mesh) {
  std::vector<Triplet> entries;
  for (int w = 0; w < mesh.wall_count(); ++w)
    entries.emplace_back(mesh.wall_face(w), w, -mesh.face_measure[mesh.wall_face(w)]);
  return matrix_of(mesh.face_count(), mesh.wall_count(), entries);
}

}  // namespace sprekk
