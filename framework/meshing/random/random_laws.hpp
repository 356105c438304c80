// Random numbers after the laws of fracture networks, the same on every machine.
#pragma once

#include <cstdint>
#include <random>
#include <string>

namespace sprekk {

/// A sequence that the C++ standard fixes: that of std::mt19937_64 from a std::seed_seq. What the standard leaves open,
/// the distributions of the header `random`, is not used.
class RandomNumbers {
 public:
  /// Sequences of different names are independent, also for one seed.
  RandomNumbers(int seed, const std::string& name);
  double uniform();  ///< strictly between 0 and 1

 private:
  std::mt19937_64 engine_;
};

/// The value with the density ~ x^(-exponent) in [low, high] below which the share u of all values lies;
/// 0 < low <= high.
double power_law(double u, double exponent, double low, double high);

/// The share of a lognormal law below x > 0: ln x is normal with the mean ln(median) and the standard deviation
/// `deviation`. Infinite x are allowed.
double lognormal_share(double x, double median, double deviation);

/// The value of a lognormal law that is cut to [low, high] below which the share u of all values lies; 0 < low < high.
double lognormal(double u, double median, double deviation, double low, double high);

/// An angle in (-pi, pi] with the density ~ exp(concentration cos(angle)), von Mises' law about 0, by the rejection of
/// Best and Fisher (1979). 0 is uniform; for large values the standard deviation is 1/sqrt(concentration).
double von_mises(RandomNumbers& random, double concentration);

}  // namespace sprekk
