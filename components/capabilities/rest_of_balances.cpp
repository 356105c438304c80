#include "components/capabilities/rest_of_balances.hpp"

#include <algorithm>
#include <cmath>

#include "framework/field/ownership.hpp"
#include "framework/invariants.hpp"
#include "framework/parallel/parallel.hpp"

namespace sprekk {

Vector rest_of_balances(const Assembly& assembly, const Field& row, const Mesh& mesh,
                        const std::function<bool(int)>& counts) {
  const auto& unknowns = assembly.unknowns();
  const auto found = std::ranges::find(unknowns, &row);
  SPREKK_EXPECT(found != unknowns.end(), row.name());
  const int unknown = static_cast<int>(found - unknowns.begin());
  const Vector &residual = assembly.residual(unknown), &in_sum = assembly.balances().residual(unknown);
  Vector rest = Vector::Zero(residual.size()), sums = Vector::Zero(2);
  for (int i = 0; i < rest.size(); ++i) {
    if (!is_owned(mesh, row.spec().location, i)) continue;
    if (counts(i)) rest[i] = residual[i];
    sums[0] += std::abs(rest[i]);
    sums[1] += in_sum[i] - residual[i];
  }
  parallel::sum(sums);
  if (sums[0] > 0) rest += sums[1] / sums[0] * rest.cwiseAbs();
  exchange(mesh, row.spec().location, 1, rest);
  return rest;
}

}  // namespace sprekk
