// The stress of a subcell, split for the method with weakly enforced symmetry.
#pragma once

#include <Eigen/Core>

#include "components/poromechanics/mpsa/mpsa.hpp"

namespace sprekk::poromechanics {

/// A gradient G_cd = d u_c / d x_d as the vector (xx, xy, yx, yy); a stress likewise.
using GradientMap = Eigen::Matrix4d;
/// From gradients to the two components of a force.
using ForceMap = Eigen::Matrix<double, 2, 4>;

/// sigma = own G + mean <G>, where <G> is a mean gradient of the interaction region: all that couples sigma_cd to the
/// transposed gradient is taken from the mean (Keilegavlen and Nordbotten 2017, Eq. 2.14). Where an anisotropic
/// stiffness couples shear and normal components, half is taken from each, which keeps `own` symmetric positive
/// definite.
struct SplitStiffness {
  GradientMap own, mean;
};

inline SplitStiffness split_stiffness(const Stiffness& c) {
  const double xs = 0.5 * c(0, 2), ys = 0.5 * c(1, 2), shear = c(2, 2);
  SplitStiffness split;
  split.own << c(0, 0), xs, xs, c(0, 1),  //
      xs, shear, 0, ys,                   //
      xs, 0, shear, ys,                   //
      c(0, 1), ys, ys, c(1, 1);
  split.mean << 0, xs, xs, 0,  //
      xs, 0, shear, ys,        //
      xs, shear, 0, ys,        //
      0, ys, ys, 0;
  return split;
}

/// The force of a stress on a face with the given normal, which is as long as the face.
inline ForceMap force_map(const GradientMap& stress, const Point& face) {
  ForceMap force;
  force.row(0) = face[0] * stress.row(0) + face[1] * stress.row(1);
  force.row(1) = face[0] * stress.row(2) + face[1] * stress.row(3);
  return force;
}

}  // namespace sprekk::poromechanics
