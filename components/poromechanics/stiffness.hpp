// The stiffness of the rock.
#pragma once

#include "framework/types.hpp"

namespace sprekk::poromechanics {

/// Stiffness in Voigt form, in plane strain or in space: (xx, yy, xy) stress = C · (xx, yy, 2 xy) strain, in space (xx,
/// yy, zz, xy, yz, xz), Pa. Symmetric positive definite.
using Stiffness = Eigen::Matrix<double, symmetric_components, symmetric_components>;
/// The stiffness of an isotropic medium with Lame's constants in Pa.
inline Stiffness isotropic_stiffness(double lame_lambda, double shear_modulus) {
  Stiffness stiffness = Stiffness::Zero();
  stiffness.topLeftCorner<dimension, dimension>().setConstant(lame_lambda);
  for (int k = 0; k < symmetric_components; ++k) stiffness(k, k) += (k < dimension ? 2 : 1) * shear_modulus;
  return stiffness;
}

/// The components of a symmetric tensor (symmetric_axes).
inline SymmetricTensor components_of(const Tensor& tensor) {
  SymmetricTensor components;
  for (int k = 0; k < symmetric_components; ++k) components[k] = tensor(symmetric_axes[k][0], symmetric_axes[k][1]);
  return components;
}

/// The strain of a displacement with this gradient, as a stiffness takes it: shears are doubled.
inline SymmetricTensor strain_of(const Tensor& gradient) {
  SymmetricTensor strain;
  for (int k = 0; k < symmetric_components; ++k) {
    const auto [i, j] = symmetric_axes[k];
    strain[k] = i == j ? gradient(i, i) : gradient(i, j) + gradient(j, i);
  }
  return strain;
}

/// A stress that is the same in all directions: 1 for xx, yy, …, 0 for shears.
inline SymmetricTensor isotropic_components() {
  SymmetricTensor components = SymmetricTensor::Zero();
  components.head<dimension>().setOnes();
  return components;
}

}  // namespace sprekk::poromechanics
