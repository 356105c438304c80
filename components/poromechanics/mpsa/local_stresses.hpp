// The forces around one node: the local problem of the MPSA-W method with pressure.
#pragma once

#include <array>
#include <vector>

#include "components/poromechanics/mpsa/mpsa.hpp"
#include "components/poromechanics/mpsa/weak_symmetry.hpp"
#include "framework/mesh/interaction_region.hpp"

namespace sprekk::poromechanics {

using FaceConditions = std::array<MechanicalCondition, 2>;

/// In every subcell the displacement is linear; displacements agree at the continuity points and forces, C : grad u - s
/// I times the normal, agree on the subfaces. Coefficients are with respect to, in this order: the displacements of the
/// region's subcells (x, y each), their isotropic stresses s, and the boundary values of the subfaces with one cell (x,
/// y each; for whole faces). Nordbotten 2016, sec. 3; Keilegavlen and Nordbotten 2017, sec. 2.
///
/// A region of a single subcell has no weak symmetry: its mean gradient is its own, so a rotation of the subcell about
/// its centre costs nothing and, unless a prescribed displacement stops it, is undetermined. The solution with the
/// least displacement of the subfaces is then taken; stress and volume change do not depend on the choice.
class LocalStresses {
 public:
  /// Throws std::runtime_error if the local system is singular for another reason.
  void solve(const InteractionRegion& region, const std::vector<Stiffness>& stiffness,
             const std::vector<FaceConditions>& conditions);

  int stress_column() const { return 2 * subcells_; }
  int boundary_column() const { return 3 * subcells_; }

  /// A component of the displacement at the continuity point of a subface (m).
  const double* displacement(int subface, int component) const {
    return system_.data() + (2 * subface + component) * width_ + 2 * subfaces_;
  }
  bool is_determined(int subface, int component) const {
    return undetermined_.empty() || !undetermined_[2 * subface + component];
  }
  /// A component of the force on a subface, with the normal out of its first cell (N/m).
  const double* force(int subface, int component) const {
    return forces_.data() + (2 * subface + component) * columns_;
  }
  /// div u integrated over a subcell (m^2).
  const double* volume_change(int subcell) const { return volumes_.data() + subcell * columns_; }

 private:
  void assemble(const InteractionRegion& region, const std::vector<FaceConditions>& conditions);
  void solve_with_least_norm();
  void find_gradients(const InteractionRegion& region);
  void find_forces(const InteractionRegion& region, const std::vector<Stiffness>& stiffness);

  int subcells_ = 0, subfaces_ = 0, columns_ = 0, width_ = 0;
  double region_area_ = 0;
  std::vector<SplitStiffness> split_;  ///< of the subcells
  std::vector<Point> mean_weight_;     ///< of the subfaces: d<G>_cd / d displacement_c
  std::vector<double> system_;         ///< the rows of [A B], then of [I A^-1 B]
  std::vector<char> undetermined_;     ///< components of displacement, or empty
  std::vector<double> gradients_;      ///< four rows a subcell, and four of the mean
  std::vector<double> forces_, volumes_;
};

}  // namespace sprekk::poromechanics
