#include "components/matrix_flow/limited_fluxes.hpp"

#include <cmath>

#include "framework/invariants.hpp"

namespace sprekk::matrix_flow {

LimitedFluxes limit(const Vector& first, const Vector& second) {
  SPREKK_EXPECT(first.size() == second.size(), first.size(), second.size());
  LimitedFluxes limited{Vector::Zero(first.size()), Vector::Zero(first.size()), Vector::Zero(first.size())};
  for (Eigen::Index i = 0; i < first.size(); ++i) {
    const double a = first[i], b = second[i];
    if (a == 0 && b == 0) {
      limited.by_first[i] = limited.by_second[i] = 0.5;
    } else if ((a > 0) == (b > 0) && a != 0 && b != 0) {
      const double share = b / (a + b);  // of the second in the sum, from 0 to 1
      limited.value[i] = 2 * share * a;
      limited.by_first[i] = 2 * share * share;
      limited.by_second[i] = 2 * (1 - share) * (1 - share);
    }
  }
  return limited;
}

}  // namespace sprekk::matrix_flow
