#include "components/poromechanics/fem/volumetric_split.hpp"

#include <Eigen/Cholesky>
#include <algorithm>

namespace sprekk::poromechanics {

namespace {

constexpr double kept_of_shear = 1 + 2.0 / dimension;  // lambda + 2 G over the dimension, over G where nu = 1/4

/// The least resistance to a change of shape along the axes or between them, Pa; G where the rock is isotropic.
double least_shear(const Stiffness& whole) {
  double least = whole(dimension, dimension);
  for (int k = dimension; k < symmetric_components; ++k) {
    const auto [i, j] = symmetric_axes[k];
    least = std::min({least, whole(k, k), (whole(i, i) + whole(j, j) - 2 * whole(i, j)) / 4});
  }
  return least;
}

}  // namespace

VolumetricSplit split_volumetric(const std::vector<Stiffness>& stiffness) {
  VolumetricSplit split{stiffness, Vector::Zero(static_cast<Eigen::Index>(stiffness.size()))};
  const SymmetricTensor volumetric = isotropic_components();
  for (std::size_t c = 0; c < stiffness.size(); ++c) {
    const Stiffness& whole = stiffness[c];
    // The largest amount that can be taken away before `kept` loses its stiffness in some direction.
    const double bulk = 1 / volumetric.dot(whole.llt().solve(volumetric));
    const double taken = std::max(0.0, bulk - kept_of_shear * least_shear(whole));
    split.taken[static_cast<Eigen::Index>(c)] = taken;
    split.kept[c] -= taken * volumetric * volumetric.transpose();
  }
  return split;
}

}  // namespace sprekk::poromechanics
