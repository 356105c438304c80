// The stiffness of the rock.
#pragma once

#include <Eigen/Core>

namespace sprekk::poromechanics {

/// Plane-strain stiffness in Voigt form: (xx, yy, xy) stress = C · (xx, yy, 2 xy) strain, Pa. Symmetric positive
/// definite.
using Stiffness = Eigen::Matrix3d;
/// The stiffness of an isotropic medium with Lame's constants in Pa.
inline Stiffness isotropic_stiffness(double lame_lambda, double shear_modulus) {
  Stiffness stiffness = Stiffness::Zero();
  stiffness.topLeftCorner<2, 2>().setConstant(lame_lambda);
  stiffness.diagonal() += shear_modulus * Eigen::Vector3d(2, 2, 1);
  return stiffness;
}

}  // namespace sprekk::poromechanics
