// The elastic problem of the fine level, factorized.
#pragma once

#include <Eigen/Core>
#include <memory>
#include <optional>
#include <vector>

#include "components/fine_fracture/fine_level/fine_rock.hpp"
#include "components/fine_fracture/quarter_point/elasticity/forces.hpp"
#include "components/fine_fracture/quarter_point/elasticity/solution.hpp"
#include "components/fine_fracture/quarter_point/elasticity/stiffness_factors.hpp"
#include "components/fine_fracture/quarter_point/elasticity/unknowns.hpp"
#include "framework/output/profile.hpp"

namespace sprekk::fine_fracture {

/// Plane-strain elasticity on quadratic triangles with quarter-point rosettes:
/// div (C eps(u) + s) + b = 0 with the loads of FineLoads. The matrix is factorized once, and all that loads and
/// factors need of the mesh is computed once; every further solve is a back-solve.
class FineModel {
 public:
  /// Solutions will have the factors of all tips, or of the `wanted` one. Times in `profile`: mesh, assembly, ordering,
  /// factorization, loads, back-solves, factors. `keeper` as for make_fine_mesh, `known` as for StiffnessFactors.
  /// Throws as make_fine_mesh does, and std::runtime_error when the matrix is singular.
  FineModel(FineGeometry geometry, const FineMeshOptions& options, FineRock rock,
            const std::optional<TipPlace>& wanted = {}, std::shared_ptr<Profile> profile = std::make_shared<Profile>(),
            TriangulationKeeper* keeper = nullptr, std::shared_ptr<const EliminationOrder> known = nullptr);

  const FineGeometry& geometry() const { return geometry_; }
  const FineMesh& mesh() const { return *mesh_; }
  const FineRock& rock() const { return rock_; }
  /// For models of the same topology.
  const std::shared_ptr<const EliminationOrder>& elimination_order() const { return factors_.order(); }

  /// The places at which each solve needs the stress offset and the body force.
  const std::vector<Point>& offset_places() const { return offset_places_; }

  /// Throws std::runtime_error when the result is not finite.
  FineSolution solve(const FineLoads& loads) const;
  /// The strain energy of C eps(u), J/m.
  double strain_energy(const FineSolution& solution) const;

 private:
  /// The right-hand side of the unknowns; `u` has all prescribed displacements, and 0 elsewhere.
  Vector right_hand_side(const FineLoads& loads, const Eigen::Matrix3Xd& offsets, const Eigen::Matrix2Xd& body_forces,
                         const Vector& u) const;
  Vector back_solve(const Vector& b) const;
  /// The displacements in some components (2 node + direction) that forces in these components alone cause: a row for
  /// each component, 0 where the displacement is prescribed.
  Eigen::MatrixXd responses_within(const std::vector<int>& components, const Eigen::MatrixXd& forces) const;
  /// The same for one set of forces, in all nodes.
  Vector response(const std::vector<int>& components, const Vector& forces) const;

  std::shared_ptr<Profile> profile_;
  FineGeometry geometry_;
  FineRock rock_;
  std::shared_ptr<const FineMesh> mesh_;
  Unknowns unknowns_;
  std::vector<ElementMatrix> stiffness_;
  StiffnessFactors factors_;
  VolumeForces volume_forces_;
  std::vector<TipEvaluation> tips_;
  std::vector<Point> offset_places_;  ///< of volume_forces_, then those of tips_
};

}  // namespace sprekk::fine_fracture
