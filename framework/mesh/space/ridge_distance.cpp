#include "framework/mesh/ridge_distance.hpp"

#include <Eigen/Geometry>
#include <stdexcept>

namespace sprekk {

double distance_to_ridge(const Mesh& mesh, int cell, int ridge) {
  // The edge lies in the plane of the cell: what the way from its middle to the centre has across it.
  const FractureCell& of = mesh.fracture_cells[cell];
  const FaceNodes& nodes = mesh.face_nodes[of.faces[0]];
  for (int k = 0; k < nodes.size(); ++k) {
    const Point &from = mesh.nodes[nodes[k]], &to = mesh.nodes[nodes.after(k)];
    if (0.5 * (from + to) == mesh.ridges[ridge].center)
      return (of.center - from).cross((to - from).normalized()).norm();
  }
  throw std::logic_error("a ridge belongs to another fracture cell");
}

}  // namespace sprekk
