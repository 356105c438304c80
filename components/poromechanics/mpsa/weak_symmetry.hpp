// The stress of a subcell, and the coupling of rotations: weakly enforced symmetry.
#pragma once

#include <Eigen/Core>
#include <Eigen/LU>

#include "components/poromechanics/mpsa/mpsa.hpp"

namespace sprekk::poromechanics {

/// A gradient G_cd = d u_c / d x_d as the vector (xx, xy, yx, yy); a stress likewise.
using GradientMap = Eigen::Matrix4d;
/// A linear function of a gradient.
using GradientRow = Eigen::RowVector4d;
/// From gradients to the two components of a force.
using ForceMap = Eigen::Matrix<double, 2, 4>;

/// C : sym G.
inline GradientMap stress_map(const Stiffness& c) {
  GradientMap stress;
  stress << c(0, 0), c(0, 2), c(0, 2), c(0, 1),  //
      c(0, 2), c(2, 2), c(2, 2), c(1, 2),        //
      c(0, 2), c(2, 2), c(2, 2), c(1, 2),        //
      c(0, 1), c(1, 2), c(1, 2), c(1, 1);
  return stress;
}

/// The force of a stress on a face with the given normal, which is as long as the face.
inline ForceMap force_map(const GradientMap& stress, const Point& face) {
  ForceMap force;
  force.row(0) = face[0] * stress.row(0) + face[1] * stress.row(1);
  force.row(1) = face[0] * stress.row(2) + face[1] * stress.row(3);
  return force;
}

/// The mean of the shear modulus over all directions, Pa.
inline double shear_modulus(const Stiffness& c) { return (c(0, 0) + c(1, 1) - 2 * c(0, 1) + 4 * c(2, 2)) / 8; }

/// The jump of the rotation between two subcells (twice), less the jump that two rocks in contact have in equilibrium:
///   rho = (r_1 − r_2) − n × a,  r = G_yx − G_xy.
/// Where displacements and tractions agree along a straight face the gradients differ by a ⊗ n, n the normal out of
/// the first. From either gradient, with the acoustic tensors A = n·C·n, the load b on the face and its length L,
///   A_1 a = (C_2 − C_1) : G_2 n + (s_1 − s_2) n + b/L,  A_2 a = (C_2 − C_1) : G_1 n + (s_1 − s_2) n + b/L.
/// The sum of both gives an a that is bounded whatever the contrast, and smooth where it vanishes. So rho is zero for
/// displacements that are linear in each of two layers.
struct RotationJump {
  GradientRow of_gradient[2];   ///< of the first and the second subcell
  double of_stress;             ///< of s_1, and of −s_2
  Eigen::RowVector2d of_load;   ///< of b, 1/N
  double strength[2] = {0, 0};  ///< N, of the couple rho strength on either subcell

  /// `half_face`: the normal out of the first, as long as half of the face.
  static RotationJump across(const Point& half_face, const Stiffness& first, const Stiffness& second) {
    const double half = half_face.norm();
    const Point n = half_face / half;
    const auto acoustic = [&n](const ForceMap& force) {
      Eigen::Matrix2d tensor;
      tensor.col(0) = force.col(0) * n[0] + force.col(1) * n[1];
      tensor.col(1) = force.col(2) * n[0] + force.col(3) * n[1];
      return tensor;
    };
    const ForceMap of_first = force_map(stress_map(first), n), of_second = force_map(stress_map(second), n);
    const Eigen::RowVector2d turning =
        Eigen::RowVector2d(-n[1], n[0]) * (acoustic(of_first) + acoustic(of_second)).inverse();
    const GradientRow rotation(0, -1, 1, 0), of_contrast = turning * (of_second - of_first);
    return {{rotation - of_contrast, -rotation - of_contrast}, -2 * turning.dot(n), -turning / half};
  }
};

}  // namespace sprekk::poromechanics
