#include "components/poromechanics/fem/volumetric_split.hpp"

#include <Eigen/Cholesky>
#include <algorithm>

namespace sprekk::poromechanics {

namespace {

constexpr double kept_of_shear = 2;  // lambda + G over G where nu = 1/4

}  // namespace

VolumetricSplit split_volumetric(const std::vector<Stiffness>& stiffness) {
  VolumetricSplit split{stiffness, Vector::Zero(static_cast<Eigen::Index>(stiffness.size()))};
  const Eigen::Vector3d volumetric(1, 1, 0);
  for (std::size_t c = 0; c < stiffness.size(); ++c) {
    const Stiffness& whole = stiffness[c];
    // The largest amount that can be taken away before `kept` loses its stiffness in some direction.
    const double bulk = 1 / volumetric.dot(whole.llt().solve(volumetric));
    const double shear = std::min(whole(2, 2), (whole(0, 0) + whole(1, 1) - 2 * whole(0, 1)) / 4);
    const double taken = std::max(0.0, bulk - kept_of_shear * shear);
    split.taken[static_cast<Eigen::Index>(c)] = taken;
    split.kept[c] -= taken * volumetric * volumetric.transpose();
  }
  return split;
}

}  // namespace sprekk::poromechanics
