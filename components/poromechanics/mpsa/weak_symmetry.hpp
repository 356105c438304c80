// The stress of a subcell, and what neighbours in contact differ by: in rotation, which weakly enforced symmetry holds
// together, and in dilation.
#pragma once

#include <Eigen/Core>
#include <Eigen/LU>
#include <algorithm>
#include <array>
#include <vector>

#include "components/poromechanics/stiffness.hpp"
#include "framework/types.hpp"

namespace sprekk::poromechanics {

inline constexpr int gradient_entries = dimension * dimension;
inline constexpr int rotations = dimension * (dimension - 1) / 2;  ///< axes of rotation: one in a plane, three in space
/// The two axes of each rotation, from the first towards the second: about the axes x, y and z in space.
inline constexpr std::array<std::array<int, 2>, rotations> rotation_axes = [] {
  std::array<std::array<int, 2>, rotations> axes{};
  for (int m = 0; m < rotations; ++m) {
    const int about = dimension == 2 ? 2 : m;
    axes[m] = {(about + 1) % 3, (about + 2) % 3};
  }
  return axes;
}();

/// A gradient G_cd = d u_c / d x_d as a vector, d running first: (xx, xy, yx, yy) in a plane; a stress likewise.
using GradientMap = Eigen::Matrix<double, gradient_entries, gradient_entries>;
/// A linear function of a gradient.
using GradientRow = Eigen::Matrix<double, 1, gradient_entries>;
/// A linear map from gradients to the components of a force.
using ForceMap = Eigen::Matrix<double, dimension, gradient_entries>;
/// A linear function of a vector.
using PointRow = Eigen::Matrix<double, 1, dimension>;

/// The place of a component of a symmetric tensor (symmetric_axes).
constexpr int symmetric_place(int i, int j) {
  for (int k = 0; k < symmetric_components; ++k) {
    const auto [a, b] = symmetric_axes[k];
    if ((a == i && b == j) || (a == j && b == i)) return k;
  }
  return 0;
}

/// C : sym G.
inline GradientMap stress_map(const Stiffness& c) {
  std::array<int, gradient_entries> place;
  for (int e = 0; e < gradient_entries; ++e) place[e] = symmetric_place(e / dimension, e % dimension);
  GradientMap stress;
  for (int i = 0; i < gradient_entries; ++i)
    for (int j = 0; j < gradient_entries; ++j)
      stress(i, j) = c(std::min(place[i], place[j]), std::max(place[i], place[j]));
  return stress;
}

/// The force of a stress on a face with the given normal, which is as long as the measure of the face.
inline ForceMap force_map(const GradientMap& stress, const Point& face) {
  ForceMap force;
  for (int c = 0; c < dimension; ++c) {
    force.row(c) = face[0] * stress.row(dimension * c);
    for (int d = 1; d < dimension; ++d) force.row(c) += face[d] * stress.row(dimension * c + d);
  }
  return force;
}

/// The mean of the shear modulus over all directions, Pa.
inline double shear_modulus(const Stiffness& c) {
  if constexpr (dimension == 2) {
    return (c(0, 0) + c(1, 1) - 2 * c(0, 1) + 4 * c(2, 2)) / 8;
  } else {
    return (c(0, 0) + c(1, 1) + c(2, 2) - c(0, 1) - c(1, 2) - c(0, 2) + 3 * (c(3, 3) + c(4, 4) + c(5, 5))) / 15;
  }
}

/// The P-wave modulus lambda + 2 G, mean over all directions, Pa.
inline double p_wave_modulus(const Stiffness& c) {
  if constexpr (dimension == 2) {
    return (c(0, 0) + c(1, 1) + 2 * c(0, 1)) / 4 + shear_modulus(c);
  } else {
    const double bulk = (c(0, 0) + c(1, 1) + c(2, 2) + 2 * (c(0, 1) + c(1, 2) + c(0, 2))) / 9;
    return bulk + 4 * shear_modulus(c) / 3;
  }
}

/// Twice the rotation number m, G_ji − G_ij for its axes i and j, as a function of the gradient.
inline GradientRow rotation_of_gradient(int m) {
  const auto [i, j] = rotation_axes[m];
  GradientRow row = GradientRow::Zero();
  row[dimension * j + i] = 1;
  row[dimension * i + j] = -1;
  return row;
}

/// A linear function of G_1 − G_2 − a ⊗ n, where G are the gradients of two subcells.
struct GradientJump {
  GradientRow of_gradient[2];  ///< of the first and the second subcell
  double of_stress;            ///< of s_1, and of −s_2
  PointRow of_load;            ///< of b, 1/Pa over the measure of the face
};

/// What two rocks in contact differ by. Where displacements and tractions agree along a flat face the gradients
/// differ by a ⊗ n, n the normal out of the first. From either gradient, with the acoustic tensors A = n·C·n, the load
/// b on the face and its measure L,
///   A_1 a = (C_2 − C_1) : G_2 n + (s_1 − s_2) n + b/L,  A_2 a = (C_2 − C_1) : G_1 n + (s_1 − s_2) n + b/L.
/// The sum of both gives an a that is bounded whatever the contrast, and smooth where it vanishes. So what is left of a
/// jump is zero for displacements that are linear in each of two layers.
class Kink {
 public:
  /// `subface`: the normal out of the first, as long as the measure of a part of the face; `share`: how large a part.
  Kink(const Point& subface, double share, const Stiffness& first, const Stiffness& second)
      : half_(subface.norm() / (2 * share)), n_(subface / subface.norm()) {
    const auto acoustic = [this](const ForceMap& force) {
      Tensor tensor;
      for (int e = 0; e < dimension; ++e) {
        tensor.col(e) = force.col(dimension * e) * n_[0];
        for (int d = 1; d < dimension; ++d) tensor.col(e) += force.col(dimension * e + d) * n_[d];
      }
      return tensor;
    };
    const ForceMap of_first = force_map(stress_map(first), n_), of_second = force_map(stress_map(second), n_);
    compliance_ = (acoustic(of_first) + acoustic(of_second)).inverse();
    contrast_ = of_second - of_first;
  }

  /// Component m of rho = (r_1 − r_2) − n × a, with twice the rotation r.
  GradientJump rotation(int m) const {
    const auto [i, j] = rotation_axes[m];
    PointRow of_a = PointRow::Zero();
    of_a[i] = -n_[j];
    of_a[j] = n_[i];
    return left_of(rotation_of_gradient(m), of_a);
  }
  /// d = (e_1 − e_2) − n · a, with the dilation e, the trace of G.
  GradientJump dilation() const {
    GradientRow trace = GradientRow::Zero();
    for (int c = 0; c < dimension; ++c) trace[(dimension + 1) * c] = 1;
    return left_of(trace, n_.transpose());
  }

 private:
  /// The jump of a function of the gradient that is of_a · a for a ⊗ n.
  GradientJump left_of(const GradientRow& function, const PointRow& of_a) const {
    const PointRow of_traction = of_a * compliance_;
    const GradientRow of_contrast = of_traction * contrast_;
    return {{function - of_contrast, -function - of_contrast}, -2 * of_traction.dot(n_), -of_traction / half_};
  }

  double half_;  ///< of the measure of the face
  Point n_;
  Tensor compliance_;
  ForceMap contrast_;
};

/// The jump of rotations across a subface, and the strength with which it turns both subcells back.
struct RotationJump {
  std::array<GradientJump, rotations> of;
  double strength[2];  ///< N (N m in space), of the couple rho strength on either subcell
};

/// A rotation of a subcell that the conditions on its faces may leave free, and that therefore follows the
/// displacements of the cells nearby.
struct HeldTurn {
  int subcell;
  GradientRow of_gradient;         ///< twice the rotation about an axis
  double strength;                 ///< as of RotationJump
  std::vector<double> of_columns;  ///< what it is by the displacements of the local cells
};

}  // namespace sprekk::poromechanics
