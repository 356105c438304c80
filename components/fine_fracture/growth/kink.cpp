#include "components/fine_fracture/growth/kink.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>

#include "framework/invariants.hpp"

namespace sprekk::fine_fracture {

namespace {

constexpr double pi = std::numbers::pi;
constexpr double pi2 = pi * pi, pi3 = pi2 * pi, pi4 = pi3 * pi, pi5 = pi4 * pi, pi6 = pi5 * pi;

// Coefficients of m^0, m^2, … (even functions) or of m, m^3, … (odd functions) with m = angle/pi.
constexpr std::array f11 = {1.0,
                            -3 * pi2 / 8,
                            pi2 - 5 * pi4 / 128,
                            pi2 / 9 - 11 * pi4 / 72 + 119 * pi6 / 15360,
                            5.07790,
                            -2.88312,
                            -0.0925,
                            2.996,
                            -4.059,
                            1.63,
                            4.1};
constexpr std::array f12 = {-3 * pi / 2,
                            10 * pi / 3 + pi3 / 16,
                            -2 * pi - 133 * pi3 / 180 + 59 * pi5 / 1280,
                            12.313906,
                            -7.32433,
                            1.5793,
                            4.0216,
                            -6.915,
                            4.21,
                            4.56};
constexpr std::array f21 = {pi / 2,
                            -(4 * pi / 3 + pi3 / 48),
                            -2 * pi / 3 + 13 * pi3 / 30 - 59 * pi5 / 3840,
                            -6.176023,
                            4.44112,
                            -1.5340,
                            -2.0700,
                            4.684,
                            -3.95,
                            -1.32};
constexpr std::array f22 = {1.0,
                            -(4 + 3 * pi2 / 8),
                            8.0 / 3 + 29 * pi2 / 18 - 5 * pi4 / 128,
                            -32.0 / 15 - 4 * pi2 / 9 - 1159 * pi4 / 7200 + 119 * pi6 / 15360,
                            10.58254,
                            -4.78511,
                            -1.8804,
                            7.280,
                            -7.591,
                            0.25,
                            12.5};
const std::array g1 = {
    0.0, 2 * pi* std::sqrt(2 * pi), -47.933390, 63.665987, -50.70880, 26.66807, -6.0205, -7.314, 10.947, -2.85, -13.7};
const std::array g2 = {-2 * std::sqrt(2 * pi),
                       12 * std::sqrt(2 * pi),
                       -59.565733,
                       61.174444,
                       -39.90249,
                       15.6222,
                       3.0343,
                       -12.781,
                       9.69,
                       6.62};

template <std::size_t n>
double even(const std::array<double, n>& coefficients, double m) {
  double sum = 0;
  for (std::size_t i = n; i-- > 0;) sum = sum * m * m + coefficients[i];
  return sum;
}

template <std::size_t n>
double odd(const std::array<double, n>& coefficients, double m) {
  return m * even(coefficients, m);
}

double bisect(const Sifs& sifs, double length, double near, double far) {
  SPREKK_EXPECT(std::abs(far) > std::abs(near), near, far);
  const double sign = std::copysign(1.0, after_kink(sifs, near, length).k2);
  constexpr int halvings = 60;  // more than a double tells apart
  for (int i = 0; i < halvings; ++i) {
    const double middle = (near + far) / 2;
    (sign * after_kink(sifs, middle, length).k2 > 0 ? near : far) = middle;
  }
  return (near + far) / 2;
}

}  // namespace

KinkFactors kink_factors(double angle) {
  const double m = angle / pi;
  return {even(f11, m), odd(f12, m), odd(f21, m), even(f22, m)};
}

Sifs after_kink(const Sifs& sifs, double angle, double length) {
  SPREKK_EXPECT(length >= 0 && std::isfinite(angle), length, angle);
  const KinkFactors f = kink_factors(angle);
  const double t = sifs.t_stress * std::sqrt(length);
  const double m = angle / pi;
  return {f.f11 * sifs.k1 + f.f12 * sifs.k2 + t * even(g1, m), f.f21 * sifs.k1 + f.f22 * sifs.k2 + t * odd(g2, m),
          sifs.t_stress};
}

double local_symmetry_angle(const Sifs& sifs, double length, double limit) {
  SPREKK_EXPECT(is_finite(sifs), sifs.k1, sifs.k2, sifs.t_stress);
  SPREKK_EXPECT(limit > 0 && limit <= pi, limit);
  if (sifs.k2 == 0) return 0;
  constexpr int steps = 32;  // parts of the limit in which the first change of sign is looked for
  const double step = -std::copysign(limit / steps, sifs.k2);
  for (int i = 1; i <= steps; ++i)
    if (after_kink(sifs, i * step, length).k2 * sifs.k2 <= 0) return bisect(sifs, length, (i - 1) * step, i * step);
  const double at_limit = after_kink(sifs, steps * step, length).k2 / sifs.k2;
  if (at_limit < 1 || length == 0) return steps * step;
  return local_symmetry_angle(sifs, 0, limit);
}

namespace {

double load_after_kink(const Sifs& sifs, double length) {
  return equivalent_sif(after_kink(sifs, local_symmetry_angle(sifs, length), length));
}

}  // namespace

double longest_overloaded_kink(const Sifs& sifs, double toughness, double low, double high) {
  constexpr int length_halvings = 40;  // of the range of lengths: a first estimate, which the search corrects
  if (load_after_kink(sifs, high) > toughness) return high;
  if (load_after_kink(sifs, low) <= toughness) return low;
  for (int k = 0; k < length_halvings; ++k) {
    const double middle = std::sqrt(low * high);
    (load_after_kink(sifs, middle) > toughness ? low : high) = middle;
  }
  return low;
}

double log_slope_of_kink(const Sifs& sifs, double length) {
  constexpr double nearby = 1.01;  // of the length
  const double longer = nearby * length;
  return std::log(load_after_kink(sifs, longer) / load_after_kink(sifs, length)) / (longer - length);
}

double largest_release_angle(const Sifs& sifs, double limit, const std::function<double(double)>& resistance) {
  SPREKK_EXPECT(is_finite(sifs), sifs.k1, sifs.k2, sifs.t_stress);
  SPREKK_EXPECT(limit > 0 && limit <= pi, limit);
  if (sifs.k2 == 0 && !resistance) return 0;
  const auto release = [&](double angle) {
    const Sifs kink = after_kink(sifs, angle);
    const double held = resistance ? resistance(angle) : 1;
    return kink.k1 > 0 ? (kink.k1 * kink.k1 + kink.k2 * kink.k2) / (held * held) : 0;
  };
  constexpr int steps = 64;  // parts of the limit among which the largest release is looked for
  const double step = -std::copysign(limit / steps, sifs.k2);
  const int first = resistance ? -steps : 0;
  int best = 0;
  for (int i = first; i <= steps; ++i)
    if (release(i * step) > release(best * step)) best = i;
  if (release(best * step) == 0) return 0;
  // The release is smooth: its slope, by central differences, changes its sign beside the best of them.
  constexpr double difference = 1e-4;  // rad: the third derivative moves the angle by 1e-9
  const auto rises = [&](double angle) {
    return release(angle + std::copysign(difference, step)) > release(angle - std::copysign(difference, step));
  };
  double low = std::max(first, best - 1) * step, high = std::min(steps, best + 1) * step;
  constexpr int halvings = 60;  // more than a double tells apart
  for (int i = 0; i < halvings; ++i) (rises((low + high) / 2) ? low : high) = (low + high) / 2;
  return (low + high) / 2;
}

}  // namespace sprekk::fine_fracture
