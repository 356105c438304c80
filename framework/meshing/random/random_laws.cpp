#include "framework/meshing/random/random_laws.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

namespace sprekk {
namespace {

/// The name as 32 bits (FNV-1a, Fowler, Noll, Vo 1991).
std::uint32_t hash_of(const std::string& name) {
  constexpr std::uint32_t basis = 2166136261, prime = 16777619;
  std::uint32_t hash = basis;
  for (const char c : name) hash = (hash ^ static_cast<unsigned char>(c)) * prime;
  return hash;
}

}  // namespace

RandomNumbers::RandomNumbers(int seed, const std::string& name) {
  std::seed_seq sequence{static_cast<std::uint32_t>(seed), hash_of(name)};
  engine_.seed(sequence);
}

double RandomNumbers::uniform() {
  constexpr int digits = std::numeric_limits<double>::digits;
  return (static_cast<double>(engine_() >> (64 - digits)) + 0.5) * std::ldexp(1.0, -digits);
}

double power_law(double u, double exponent, double low, double high) {
  // The integral of x^(-a) from low to x, over that to high, is u. With r = x/low and b = 1 - a it is
  // (r^b - 1)/(R^b - 1) = u; expm1 and log1p keep all digits where b is small.
  const double range = std::log(high / low), b = 1 - exponent;
  const double log_ratio = b == 0 ? u * range : std::log1p(u * std::expm1(b * range)) / b;
  return std::clamp(low * std::exp(log_ratio), low, high);
}

double lognormal_share(double x, double median, double deviation) {
  return 0.5 * std::erfc(-std::log(x / median) / (deviation * std::numbers::sqrt2));
}

double lognormal(double u, double median, double deviation, double low, double high) {
  const double below = lognormal_share(low, median, deviation), above = lognormal_share(high, median, deviation);
  const double share = below + u * (above - below);
  double left = std::log(low), right = std::log(high);
  constexpr int halvings = 60;  // to the last bit
  for (int i = 0; i < halvings; ++i) {
    const double middle = 0.5 * (left + right);
    (lognormal_share(std::exp(middle), median, deviation) < share ? left : right) = middle;
  }
  return std::exp(0.5 * (left + right));
}

double von_mises(RandomNumbers& random, double concentration) {
  using std::numbers::pi;
  // Below this value the method loses digits, and the law is uniform up to this share.
  constexpr double uniform_below = 1e-5;
  if (concentration < uniform_below) return pi * (2 * random.uniform() - 1);
  // A wrapped Cauchy law with the parameter rho lies above the density.
  const double r = 1 + std::sqrt(1 + 4 * concentration * concentration);
  const double rho = (r - std::sqrt(2 * r)) / (2 * concentration), s = (1 + rho * rho) / (2 * rho);
  for (;;) {
    const double z = std::cos(pi * random.uniform()), cosine = (1 + s * z) / (s + z), c = concentration * (s - cosine);
    const double u = random.uniform();
    if (c * (2 - c) <= u && std::log(c / u) + 1 < c) continue;
    const double angle = std::acos(std::clamp(cosine, -1.0, 1.0));
    return random.uniform() < 0.5 ? -angle : angle;
  }
}

}  // namespace sprekk
