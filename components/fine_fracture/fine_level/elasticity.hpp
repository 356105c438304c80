// Isotropic elasticity in plane strain.
#pragma once

#include <Eigen/Core>

#include "framework/types.hpp"

namespace sprekk::fine_fracture {

/// Lame's constants, Pa.
struct Elasticity {
  double lambda, shear;
  bool operator==(const Elasticity&) const = default;

  double poisson_ratio() const { return lambda / (2 * (lambda + shear)); }
  double kolosov() const { return 3 - 4 * poisson_ratio(); }            ///< kappa
  double plane_modulus() const { return 8 * shear / (kolosov() + 1); }  ///< E' = E / (1 - nu^2), Pa

  /// The stress (Pa) of a displacement gradient, du_i/dx_j at (i, j).
  Tensor stress(const Tensor& gradient) const {
    const Tensor doubled = gradient + gradient.transpose();
    return shear * doubled + lambda * gradient.trace() * Tensor::Identity();
  }
  /// The in-plane strain of a stress.
  Tensor strain(const Tensor& stress) const {
    return (stress - poisson_ratio() * stress.trace() * Tensor::Identity()) / (2 * shear);
  }
};

/// A symmetric tensor from (xx, yy, xy).
inline Tensor symmetric(const Eigen::Vector3d& v) {
  Tensor t;
  t << v[0], v[2], v[2], v[1];
  return t;
}

}  // namespace sprekk::fine_fracture
