// Nodal forces of tractions and of the stress offset.
#pragma once

#include "components/fine_fracture/quarter_point/domain/fine_mesh.hpp"
#include "components/fine_fracture/quarter_point/elasticity/fine_rock.hpp"
#include "components/fine_fracture/quarter_point/elasticity/loads.hpp"

namespace sprekk::fine_fracture {

/// The integrals of t . v over the outline and the walls; (x, y) per node, N/m.
Vector traction_forces(const FineGeometry& geometry, const FineMesh& mesh, const FineLoads& loads);

/// The nodal forces of the stress offset s: the integral of s : eps(v) over the domain. All that follows from the mesh
/// is computed once.
class OffsetForces {
 public:
  OffsetForces(const FineMesh& mesh, const FineRock& rock);
  const std::vector<Point>& places() const { return places_; }
  /// Subtracts the nodal forces; `offsets`: (xx, yy, xy) in Pa, a column for each of places().
  void subtract_from(Vector& forces, const Eigen::Ref<const Eigen::Matrix3Xd>& offsets) const;

 private:
  /// What the offset at one place adds to the forces of an element.
  struct Share {
    std::array<int, 6> nodes;
    Eigen::Matrix<double, 6, 2> gradient;  ///< of their shape functions, times the area that the place stands for, m
  };
  std::vector<Point> places_;
  std::vector<Share> shares_;  ///< by place
};

}  // namespace sprekk::fine_fracture
