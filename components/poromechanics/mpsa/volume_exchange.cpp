#include "components/poromechanics/mpsa/volume_exchange.hpp"

#include <algorithm>

namespace sprekk::poromechanics {

void VolumeExchange::assign(const Mesh& mesh, const InteractionRegion& region, const std::vector<Stiffness>& stiffness,
                            const std::vector<GradientJump>& dilation) {
  subfaces.clear();
  volume.resize(0, 0);
  for (int f = 0; f < region.subface_count(); ++f)
    if (region.is_inner(f)) subfaces.push_back(f);
  const int count = static_cast<int>(subfaces.size());
  if (count < 3) return;

  Eigen::VectorXd root(count);  // of c
  Eigen::MatrixX2d slopes(count, 2);
  for (int i = 0; i < count; ++i) {
    const auto [first, second] = region.neighbours[subfaces[i]];
    const Subcell &one = region.subcells[first], &other = region.subcells[second];
    const double moduli[2] = {p_wave_modulus(stiffness[one.cell]), p_wave_modulus(stiffness[other.cell])};
    const double least = std::min(one.area / moduli[0], other.area / moduli[1]);
    root[i] = std::sqrt(0.25 * least * std::min(moduli[0], moduli[1]) / modulus(dilation[subfaces[i]]));
    slopes.row(i) = root[i] * (mesh.cell_center[one.cell] - mesh.cell_center[other.cell]).transpose();
  }
  // Unit columns that span what a slope makes.
  if (slopes.col(1).squaredNorm() > slopes.col(0).squaredNorm()) slopes.col(0).swap(slopes.col(1));
  const double largest = slopes.col(0).norm();
  slopes.col(0) /= largest;
  for (int again = 0; again < 2; ++again) slopes.col(1) -= slopes.col(0) * slopes.col(0).dot(slopes.col(1));
  const double rest = slopes.col(1).norm();
  if (rest > 1e-8 * largest)
    slopes.col(1) /= rest;
  else
    slopes.col(1).setZero();  // all centres on a line
  volume = -slopes * slopes.transpose();
  volume.diagonal().array() += 1;
  volume = root.asDiagonal() * volume * root.asDiagonal();
}

}  // namespace sprekk::poromechanics
