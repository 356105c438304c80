#include "components/matrix_flow/limited_fluxes.hpp"

#include <cmath>

#include "framework/invariants.hpp"

namespace sprekk::matrix_flow {

namespace {

/// x+ and its derivative, with all digits for x < 0.
struct RoundedPart {
  RoundedPart(double x, double rounding) {
    const double root = std::hypot(x, rounding);
    value = x > 0 ? (x + root) / 2 : rounding * (rounding / (2 * (root - x)));
    slope = value / root;
  }
  double value, slope;
};

void add_rounded(double a, double b, double rounding, double sign, Eigen::Index i, LimitedFluxes& limited) {
  const RoundedPart first(sign * a, rounding), second(sign * b, rounding);
  const double share = second.value / (first.value + second.value);
  limited.value[i] += sign * 2 * share * first.value;
  limited.by_first[i] += 2 * share * share * first.slope;
  limited.by_second[i] += 2 * (1 - share) * (1 - share) * second.slope;
}

LimitedFluxes rounded(const Vector& first, const Vector& second, double rounding) {
  LimitedFluxes limited{Vector::Zero(first.size()), Vector::Zero(first.size()), Vector::Zero(first.size())};
  for (Eigen::Index i = 0; i < first.size(); ++i)
    for (const double sign : {1.0, -1.0}) add_rounded(first[i], second[i], rounding, sign, i, limited);
  return limited;
}

LimitedFluxes limit_with_secants(const Vector& first, const Vector& second) {
  LimitedFluxes limited{Vector::Zero(first.size()), Vector::Zero(first.size()), Vector::Zero(first.size())};
  for (Eigen::Index i = 0; i < first.size(); ++i) {
    const double a = first[i], b = second[i], sum = std::abs(a) + std::abs(b);
    const double share = sum > 0 ? std::abs(b) / sum : 0.5;
    limited.by_first[i] = share;
    limited.by_second[i] = 1 - share;
    if ((a > 0) == (b > 0)) limited.value[i] = 2 * share * a;
  }
  return limited;
}

}  // namespace

LimitedFluxes limit(const Vector& first, const Vector& second, double rounding) {
  SPREKK_EXPECT(first.size() == second.size(), first.size(), second.size());
  if (rounding == with_secants) return limit_with_secants(first, second);
  SPREKK_EXPECT(rounding >= 0, rounding);
  if (std::isinf(rounding))
    return {(first + second) / 2, Vector::Constant(first.size(), 0.5), Vector::Constant(first.size(), 0.5)};
  if (rounding > 0) return rounded(first, second, rounding);
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
