#include "framework/study/sample_points.hpp"

#include <array>
#include <cmath>
#include <numbers>
#include <numeric>
#include <random>
#include <stdexcept>

#include "framework/invariants.hpp"

namespace sprekk {
namespace {

constexpr int bits = 32;

/// Strictly between 0 and 1. The distributions of the standard library differ from machine to machine.
double uniform(std::mt19937_64& random) {
  constexpr int digits = 53;
  return (static_cast<double>(random() >> (64 - digits)) + 0.5) * std::ldexp(1.0, -digits);
}

SamplePoints empty_points(int count, int dimensions) {
  SPREKK_EXPECT(count > 0 && dimensions > 0, count, dimensions);
  return SamplePoints(static_cast<std::size_t>(count), std::vector<double>(static_cast<std::size_t>(dimensions)));
}

/// A primitive polynomial x^degree + … + 1 with the coefficients between as bits, and the first direction numbers.
struct Directions {
  int degree;
  std::uint32_t coefficients;
  std::array<std::uint32_t, 5> first;
};
constexpr std::array<Directions, most_sobol_dimensions - 1> joe_and_kuo = {{{1, 0, {1}},
                                                                            {2, 1, {1, 3}},
                                                                            {3, 1, {1, 3, 1}},
                                                                            {3, 2, {1, 1, 1}},
                                                                            {4, 1, {1, 1, 3, 3}},
                                                                            {4, 4, {1, 3, 5, 13}},
                                                                            {5, 2, {1, 1, 5, 5, 17}},
                                                                            {5, 4, {1, 1, 5, 5, 5}},
                                                                            {5, 7, {1, 1, 7, 11, 19}}}};

std::array<std::uint32_t, bits> direction_numbers(int dimension) {
  std::array<std::uint32_t, bits> v{};
  if (dimension == 0) {
    for (int i = 0; i < bits; ++i) v[i] = std::uint32_t{1} << (bits - 1 - i);
    return v;
  }
  const Directions& d = joe_and_kuo[dimension - 1];
  for (int i = 0; i < bits; ++i) {
    if (i < d.degree) {
      v[i] = d.first[i] << (bits - 1 - i);
      continue;
    }
    v[i] = v[i - d.degree] ^ (v[i - d.degree] >> d.degree);
    for (int k = 1; k < d.degree; ++k)
      if ((d.coefficients >> (d.degree - 1 - k)) & 1) v[i] ^= v[i - k];
  }
  return v;
}

}  // namespace

SamplePoints random_points(int count, int dimensions, std::uint64_t seed) {
  SamplePoints points = empty_points(count, dimensions);
  std::mt19937_64 random(seed);
  for (std::vector<double>& point : points)
    for (double& x : point) x = uniform(random);
  return points;
}

SamplePoints latin_hypercube(int count, int dimensions, std::uint64_t seed) {
  SamplePoints points = empty_points(count, dimensions);
  std::mt19937_64 random(seed);
  std::vector<int> order(points.size());
  for (int k = 0; k < dimensions; ++k) {
    std::iota(order.begin(), order.end(), 0);
    for (std::size_t i = order.size() - 1; i > 0; --i)
      std::swap(order[i], order[static_cast<std::size_t>(uniform(random) * static_cast<double>(i + 1))]);
    for (std::size_t i = 0; i < points.size(); ++i) points[i][k] = (order[i] + uniform(random)) / count;
  }
  return points;
}

SamplePoints sobol_points(int count, int dimensions, std::uint64_t seed) {
  if (dimensions > most_sobol_dimensions) throw std::logic_error("too many dimensions for Sobol's sequence");
  SamplePoints points = empty_points(count, dimensions);
  std::mt19937_64 random(seed);
  for (int k = 0; k < dimensions; ++k) {
    const auto directions = direction_numbers(k);
    std::uint32_t digits = static_cast<std::uint32_t>(random() >> bits);
    for (std::size_t i = 0; i < points.size(); ++i) {
      points[i][k] = (digits + 0.5) * std::ldexp(1.0, -bits);
      int lowest_zero = 0;  // of the number of the point: Gray's order
      while ((i >> lowest_zero) & 1) ++lowest_zero;
      digits ^= directions[lowest_zero];
    }
  }
  return points;
}

double normal_quantile(double p) {
  SPREKK_EXPECT(p > 0 && p < 1, p);
  double low = -40, high = 40;
  for (int i = 0; i < 100; ++i) {
    const double middle = (low + high) / 2;
    (std::erfc(-middle / std::numbers::sqrt2) / 2 < p ? low : high) = middle;
  }
  return (low + high) / 2;
}

}  // namespace sprekk
