// Volume that the subcells around a node exchange, so that their dilation does not alternate.
#pragma once

#include <Eigen/Core>
#include <vector>

#include "components/poromechanics/mpsa/limits.hpp"
#include "components/poromechanics/mpsa/weak_symmetry.hpp"
#include "framework/discretization/interaction_region.hpp"

namespace sprekk::poromechanics {

/// Where tractions agree across a face, so does q = M e − s (e dilation, M P-wave modulus, s isotropic stress) except
/// for what changes along the face. In even rock without body force
///   div(C : grad u) = grad s  means  grad q = G curl r  (r = twice the rotation),
/// so q is harmonic and as smooth as r, however rough s is. A local problem returns it with errors of the size of a
/// subcell times its slope, which alternate around the node. So across its inner subfaces neighbours exchange the
/// volume
///   E y,  E = c − c x (x' c x)^-1 x' c,
/// from the first subcell to the second, where y is the jump of q (Kink: M times the jump of dilation that is left,
/// with the mean M of the two), x the vector between their centres, and c = 1/(2 n) of the smaller A/M, times M of the
/// softer over the mean, where n is how many inner subfaces a subcell has: 2 in a plane, up to 3 in space. The part of
/// y that belongs to a slope of q is left out, so that a linear q stays.
/// - Nothing is exchanged where two layers meet that each have a linear displacement, at any contrast.
/// - No volume is gained in total, and none overshoots: with T the differences of neighbours, T' E T <= A/M. With
///   more than 1/(2 n) it could exceed that, where subcells are equal.
/// - What s exchanges, T' E T s, is symmetric and positive semidefinite.
/// - An error of y in stiff rock moves no more volume than belongs to that rock, even where the error is large as a
///   stress.
class VolumeExchange {
 public:
  std::vector<int> subfaces;  ///< the inner ones; none where there are fewer than three: these determine only a slope
  Eigen::MatrixXd volume;     ///< E, m^2/Pa (m^3/Pa in space)

  /// `most`: 1/(2 n) in c for n = 2.
  void assign(const Mesh& mesh, const InteractionRegion& region, const std::vector<Stiffness>& stiffness,
              const std::vector<GradientJump>& dilation, double most = MpsaLimits().exchange);
  /// The mean M, Pa: times the jump of dilation it gives y, which has −s_1 + s_2 in it.
  static double modulus(const GradientJump& dilation) { return -1 / dilation.of_stress; }

 private:
  Eigen::VectorXd root_;  ///< of c
  Eigen::Matrix<double, Eigen::Dynamic, dimension> slope_;
  std::vector<int> inner_;  ///< of the subcells: inner subfaces
};

}  // namespace sprekk::poromechanics
