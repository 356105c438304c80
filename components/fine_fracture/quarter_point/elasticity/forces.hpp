// Nodal forces of tractions, of the stress offset and of the body force.
#pragma once

#include "components/fine_fracture/fine_level/fine_rock.hpp"
#include "components/fine_fracture/fine_level/loads.hpp"
#include "components/fine_fracture/quarter_point/mesh/fine_mesh.hpp"

namespace sprekk::fine_fracture {

/// The integrals of t . v over the outline and the walls; (x, y) per node, N/m.
Vector traction_forces(const FineGeometry& geometry, const FineMesh& mesh, const FineLoads& loads);

/// The nodal forces of the stress offset s and of the body force b: the integrals of s : eps(v) and b . v over the
/// domain. All that follows from the mesh is computed once.
class VolumeForces {
 public:
  VolumeForces(const FineMesh& mesh, const FineRock& rock);
  const std::vector<Point>& places() const { return places_; }
  /// Subtracts the nodal forces; `offsets`: (xx, yy, xy) in Pa, a column for each of places().
  void subtract_offsets(Vector& forces, const Eigen::Ref<const Eigen::Matrix3Xd>& offsets) const;
  /// Adds the nodal forces; `body_forces`: (x, y) in N/m^3, a column for each of places().
  void add_body_forces(Vector& forces, const Eigen::Ref<const Eigen::Matrix2Xd>& body_forces) const;

 private:
  /// What the loads at one place add to the forces of an element.
  struct Share {
    std::array<int, 6> nodes;
    Eigen::Matrix<double, 6, 2> gradient;  ///< of their shape functions, times the area that the place stands for, m
    Eigen::Matrix<double, 6, 1> value;     ///< the same, m^2
  };
  std::vector<Point> places_;
  std::vector<Share> shares_;  ///< by place
};

}  // namespace sprekk::fine_fracture
