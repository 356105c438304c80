// The stress of a subcell, and what neighbours in contact differ by: in rotation, which weakly enforced symmetry holds
// together, and in dilation.
#pragma once

#include <Eigen/Core>
#include <Eigen/LU>

#include "components/poromechanics/stiffness.hpp"
#include "framework/types.hpp"

namespace sprekk::poromechanics {

/// A gradient G_cd = d u_c / d x_d as the vector (xx, xy, yx, yy); a stress likewise.
using GradientMap = Eigen::Matrix4d;
/// A linear function of a gradient.
using GradientRow = Eigen::RowVector4d;
/// A linear map from gradients to the two components of a force.
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

/// The P-wave modulus lambda + 2 G, mean over all directions, Pa.
inline double p_wave_modulus(const Stiffness& c) { return (c(0, 0) + c(1, 1) + 2 * c(0, 1)) / 4 + shear_modulus(c); }

/// A linear function of G_1 − G_2 − a ⊗ n, where G are the gradients of two subcells.
struct GradientJump {
  GradientRow of_gradient[2];  ///< of the first and the second subcell
  double of_stress;            ///< of s_1, and of −s_2
  Eigen::RowVector2d of_load;  ///< of b, m/N
};

/// What two rocks in contact differ by. Where displacements and tractions agree along a straight face the gradients
/// differ by a ⊗ n, n the normal out of the first. From either gradient, with the acoustic tensors A = n·C·n, the load
/// b on the face and its length L,
///   A_1 a = (C_2 − C_1) : G_2 n + (s_1 − s_2) n + b/L,  A_2 a = (C_2 − C_1) : G_1 n + (s_1 − s_2) n + b/L.
/// The sum of both gives an a that is bounded whatever the contrast, and smooth where it vanishes. So what is left of a
/// jump is zero for displacements that are linear in each of two layers.
class Kink {
 public:
  /// `half_face`: the normal out of the first, as long as half of the face.
  Kink(const Point& half_face, const Stiffness& first, const Stiffness& second)
      : half_(half_face.norm()), n_(half_face / half_) {
    const auto acoustic = [this](const ForceMap& force) {
      Eigen::Matrix2d tensor;
      tensor.col(0) = force.col(0) * n_[0] + force.col(1) * n_[1];
      tensor.col(1) = force.col(2) * n_[0] + force.col(3) * n_[1];
      return tensor;
    };
    const ForceMap of_first = force_map(stress_map(first), n_), of_second = force_map(stress_map(second), n_);
    compliance_ = (acoustic(of_first) + acoustic(of_second)).inverse();
    contrast_ = of_second - of_first;
  }

  /// rho = (r_1 − r_2) − n × a, with twice the rotation r = G_yx − G_xy.
  GradientJump rotation() const { return left_of(GradientRow(0, -1, 1, 0), {-n_[1], n_[0]}); }
  /// d = (e_1 − e_2) − n · a, with the dilation e = G_xx + G_yy.
  GradientJump dilation() const { return left_of(GradientRow(1, 0, 0, 1), {n_[0], n_[1]}); }

 private:
  /// The jump of a function of the gradient that is of_a · a for a ⊗ n.
  GradientJump left_of(const GradientRow& function, const Eigen::RowVector2d& of_a) const {
    const Eigen::RowVector2d of_traction = of_a * compliance_;
    const GradientRow of_contrast = of_traction * contrast_;
    return {{function - of_contrast, -function - of_contrast}, -2 * of_traction.dot(n_), -of_traction / half_};
  }

  double half_;
  Point n_;
  Eigen::Matrix2d compliance_;
  ForceMap contrast_;
};

/// The jump of rotations across a half face, and the strength with which it turns both subcells back.
struct RotationJump : GradientJump {
  double strength[2];  ///< N, of the couple rho strength on either subcell
};

}  // namespace sprekk::poromechanics
