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

  inner_.assign(region.subcell_count(), 0);
  for (const int f : subfaces)
    for (const int k : region.neighbours[f]) ++inner_[k];
  root_.resize(count);
  slope_.resize(count, dimension);
  for (int i = 0; i < count; ++i) {
    const auto [first, second] = region.neighbours[subfaces[i]];
    const Subcell &one = region.subcells[first], &other = region.subcells[second];
    const double moduli[2] = {p_wave_modulus(stiffness[one.cell]), p_wave_modulus(stiffness[other.cell])};
    const double least = std::min(one.measure / moduli[0], other.measure / moduli[1]);
    const double part = 2 * most / std::max(inner_[first], inner_[second]);
    root_[i] = std::sqrt(part * least * std::min(moduli[0], moduli[1]) / modulus(dilation[subfaces[i]]));
    slope_.row(i) = root_[i] * (mesh.cell_center[one.cell] - mesh.cell_center[other.cell]).transpose();
  }
  // Orthogonal unit columns that span the changes of q by slopes: the longest first.
  double longest = 0;
  for (int c = 0; c < dimension; ++c) {
    for (int other = c + 1; other < dimension; ++other)
      if (slope_.col(other).squaredNorm() > slope_.col(c).squaredNorm()) slope_.col(c).swap(slope_.col(other));
    for (int again = 0; again < 2; ++again)
      for (int done = 0; done < c; ++done) slope_.col(c) -= slope_.col(done).dot(slope_.col(c)) * slope_.col(done);
    const double rest = slope_.col(c).norm();
    if (c == 0) longest = rest;
    constexpr double on_a_line = 1e-8;  // what the second subtraction leaves of columns that are parallel: round-off
    if (rest > on_a_line * longest)
      slope_.col(c) /= rest;
    else
      slope_.col(c).setZero();  // all centres lie on a line, or in a plane
  }
  for (int i = 0; i < count; ++i)
    for (int j = 0; j < count; ++j)
      volume(i, j) = root_[i] * root_[j] * ((i == j ? 1 : 0) - slope_.row(i).dot(slope_.row(j)));
}

}  // namespace sprekk::poromechanics
