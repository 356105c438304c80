// The dual basis of a few vectors.
#pragma once

#include <Eigen/Core>
#include <Eigen/Geometry>
#include <array>

#include "framework/assert.hpp"

namespace sprekk {

/// The vectors whose products with `arms` are 1 for the same index and 0 for others: where v differs from its value at
/// a place by d[i] at this place + arms[i], and is linear, grad v = sum_i dual[i] d[i]. 1/m for arms in m.
/// To be called with the dimension, dual_vectors<dimension>(arms).
template <int d>
std::array<Eigen::Matrix<double, d, 1>, d> dual_vectors(const std::array<Eigen::Matrix<double, d, 1>, d>& arms) {
  using Vector = Eigen::Matrix<double, d, 1>;
  if constexpr (d == 2) {
    const double determinant = arms[0][0] * arms[1][1] - arms[0][1] * arms[1][0];
    SPREKK_ASSERT(determinant != 0, determinant);
    return {Vector(arms[1][1], -arms[1][0]) / determinant, Vector(-arms[0][1], arms[0][0]) / determinant};
  } else {
    const std::array<Vector, d> across{arms[1].cross(arms[2]), arms[2].cross(arms[0]), arms[0].cross(arms[1])};
    const double determinant = arms[0].dot(across[0]);
    SPREKK_ASSERT(determinant != 0, determinant);
    return {across[0] / determinant, across[1] / determinant, across[2] / determinant};
  }
}

}  // namespace sprekk
