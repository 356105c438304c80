#include "framework/meshing/random/random_laws.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <numbers>
#include <vector>

namespace sprekk {
namespace {

constexpr int many = 20000;
using std::numbers::pi;

/// The largest distance between the shares of a sample and those of a law, times the root of its size. Kolmogorov: it
/// is above 1.95 for one sample of 1000 that follows the law.
double kolmogorov(std::vector<double> sample, const std::function<double(double)>& share) {
  std::sort(sample.begin(), sample.end());
  const auto n = static_cast<double>(sample.size());
  double largest = 0;
  for (std::size_t i = 0; i < sample.size(); ++i) {
    const double of_law = share(sample[i]);
    largest = std::max({largest, static_cast<double>(i + 1) / n - of_law, of_law - static_cast<double>(i) / n});
  }
  return largest * std::sqrt(n);
}
constexpr double one_of_thousand = 1.95;

std::vector<double> sample(const std::string& name, const std::function<double(RandomNumbers&)>& draw,
                           int count = many) {
  RandomNumbers random(5, name);
  std::vector<double> values;
  for (int i = 0; i < count; ++i) values.push_back(draw(random));
  return values;
}

/// The integral of a density from `from` to `to` by Simpson's rule.
double integral(const std::function<double(double)>& density, double from, double to) {
  constexpr int parts = 400;
  const double h = (to - from) / parts;
  double sum = density(from) + density(to);
  for (int i = 1; i < parts; ++i) sum += (i % 2 == 1 ? 4 : 2) * density(from + i * h);
  return sum * h / 3;
}

TEST(RandomLaws, NumbersAreUniformAndThoseOfNamesAndSeedsIndependent) {
  const auto uniform = [](RandomNumbers& random) { return random.uniform(); };
  const auto a = sample("a", uniform), b = sample("b", uniform);
  EXPECT_LT(kolmogorov(a, [](double u) { return u; }), one_of_thousand);
  EXPECT_EQ(a, sample("a", uniform));
  RandomNumbers first(1, "a"), second(2, "a");
  EXPECT_NE(first.uniform(), second.uniform());
  double covariance = 0;
  for (int i = 0; i < many; ++i) covariance += (a[i] - 0.5) * (b[i] - 0.5) / many;
  EXPECT_LT(std::abs(covariance) * 12, 3.3 / std::sqrt(many));  // 12: over the variance; normal for many numbers
}

TEST(RandomLaws, PowerLaws) {
  for (const double exponent : {0.0, 1.0, 1 + 1e-12, 2.5, 4.0}) {
    SCOPED_TRACE(exponent);
    const double low = 3, high = 50;
    const auto share = [&](double x) {
      if (std::abs(exponent - 1) < 1e-9) return std::log(x / low) / std::log(high / low);
      const auto primitive = [&](double y) { return std::pow(y, 1 - exponent) / (1 - exponent); };
      return (primitive(x) - primitive(low)) / (primitive(high) - primitive(low));
    };
    const auto drawn = sample("p", [&](RandomNumbers& r) { return power_law(r.uniform(), exponent, low, high); });
    EXPECT_LT(kolmogorov(drawn, share), one_of_thousand);
    const auto [least, most] = std::ranges::minmax(drawn);
    EXPECT_GE(least, low);
    EXPECT_LE(most, high);
    // Another exponent is told apart.
    const auto other = sample("p", [&](RandomNumbers& r) { return power_law(r.uniform(), exponent + 0.2, low, high); });
    EXPECT_GT(kolmogorov(other, share), one_of_thousand);
  }
}

TEST(RandomLaws, LognormalLawsAreCut) {
  const double median = 8, deviation = 0.7, low = 4, high = 30;
  const auto normal = [](double z) { return std::exp(-0.5 * z * z); };
  const auto standard = [&](double x) { return std::log(x / median) / deviation; };
  const double whole = integral(normal, standard(low), standard(high));
  const auto share = [&](double x) { return integral(normal, standard(low), standard(x)) / whole; };
  const auto drawn = sample(
      "l", [&](RandomNumbers& r) { return lognormal(r.uniform(), median, deviation, low, high); }, 4000);
  EXPECT_LT(kolmogorov(drawn, share), one_of_thousand);
  EXPECT_GE(*std::ranges::min_element(drawn), low);
  EXPECT_LE(*std::ranges::max_element(drawn), high);
  // Without the cut the law is another one.
  const auto uncut = [&](double x) { return integral(normal, -8, standard(x)) / std::sqrt(2 * pi); };
  EXPECT_GT(kolmogorov(drawn, uncut), one_of_thousand);
}

TEST(RandomLaws, VonMisesLaws) {
  for (const double kappa : {0.0, 1e-6, 0.1, 1.0, 20.0, 3000.0}) {
    SCOPED_TRACE(kappa);
    const auto density = [&](double angle) { return std::exp(kappa * (std::cos(angle) - 1)); };
    // Beyond eight standard deviations there is nothing.
    const double end = kappa > 10 ? std::min(pi, 8 / std::sqrt(kappa)) : pi, whole = integral(density, -end, end);
    const auto share = [&](double angle) { return integral(density, -end, std::clamp(angle, -end, end)) / whole; };
    const auto drawn = sample(
        "v", [&](RandomNumbers& r) { return von_mises(r, kappa); }, 4000);
    EXPECT_LT(kolmogorov(drawn, share), one_of_thousand);
    const auto other = sample(
        "v", [&](RandomNumbers& r) { return von_mises(r, 1.3 * kappa + 0.3); }, 4000);
    EXPECT_GT(kolmogorov(other, share), one_of_thousand);
  }
}

TEST(RandomLaws, TheResultantOfVonMisesLawIsARatioOfBesselFunctions) {
  // Mardia and Jupp (2000), Eq. 3.5.31; the variance of cos is below that of a single value, 1.
  for (const double kappa : {1.0, 2.0, 10.0}) {
    const auto cosines = sample("r", [&](RandomNumbers& r) { return std::cos(von_mises(r, kappa)); });
    double mean = 0;
    for (const double c : cosines) mean += c / many;
    const double expected = std::cyl_bessel_i(1, kappa) / std::cyl_bessel_i(0, kappa);
    const double variance = 1 - expected / kappa - expected * expected;  // of cos
    EXPECT_LT(std::abs(mean - expected), 3.3 * std::sqrt(variance / many)) << kappa;
  }
}

}  // namespace
}  // namespace sprekk
