#include "components/poromechanics/mpsa/volume_exchange.hpp"

#include <algorithm>

#include "framework/invariants.hpp"

namespace sprekk::poromechanics {

void VolumeExchange::assign(const Mesh& mesh, const InteractionRegion& region, const std::vector<Stiffness>& stiffness,
                            const std::vector<GradientJump>& dilation, double most) {
  SPREKK_EXPECT(most >= 0, most);
  subfaces.clear();
  for (int f = 0; f < region.subface_count(); ++f)
    if (region.is_inner(f)) subfaces.push_back(f);
  if (subfaces.size() < 3) subfaces.clear();
  const int count = static_cast<int>(subfaces.size());
  volume.resize(count, count);
  if (count == 0) return;

  root_.resize(count);
  slope_.resize(count, 2);
  for (int i = 0; i < count; ++i) {
    const auto [first, second] = region.neighbours[subfaces[i]];
    const Subcell &one = region.subcells[first], &other = region.subcells[second];
    const double moduli[2] = {p_wave_modulus(stiffness[one.cell]), p_wave_modulus(stiffness[other.cell])};
    const double least = std::min(one.measure / moduli[0], other.measure / moduli[1]);
    root_[i] = std::sqrt(most * least * std::min(moduli[0], moduli[1]) / modulus(dilation[subfaces[i]]));
    slope_.row(i) = root_[i] * (mesh.cell_center[one.cell] - mesh.cell_center[other.cell]).transpose();
  }
  // Orthogonal unit columns that span the changes of q by slopes.
  if (slope_.col(1).squaredNorm() > slope_.col(0).squaredNorm()) slope_.col(0).swap(slope_.col(1));
  const double longest = slope_.col(0).norm();
  slope_.col(0) /= longest;
  for (int again = 0; again < 2; ++again) slope_.col(1) -= slope_.col(0).dot(slope_.col(1)) * slope_.col(0);
  const double rest = slope_.col(1).norm();
  constexpr double on_a_line = 1e-8;  // what the second subtraction leaves of columns that are parallel: round-off
  if (rest > on_a_line * longest)
    slope_.col(1) /= rest;
  else
    slope_.col(1).setZero();  // all centres lie on a line
  for (int i = 0; i < count; ++i)
    for (int j = 0; j < count; ++j)
      volume(i, j) = root_[i] * root_[j] * ((i == j ? 1 : 0) - slope_.row(i).dot(slope_.row(j)));
}

}  // namespace sprekk::poromechanics
