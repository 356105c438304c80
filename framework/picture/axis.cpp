#include "framework/picture/axis.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "framework/no_value.hpp"
#include "framework/picture/display_unit.hpp"
#include "framework/round_off.hpp"

namespace sprekk {
namespace {

constexpr double margin = 0.04;  // of the range, beyond the outermost values

double round_step(double least) {
  const double power = std::pow(10.0, std::floor(std::log10(least)));
  for (const double factor : {1.0, 2.0, 5.0})
    if (factor * power >= least * (1 - rounding::same)) return factor * power;
  return 10 * power;
}

}  // namespace

Axis::Axis(const std::vector<double>& values, Scale scale, int tick_count) : scale_(scale) {
  double low = std::numeric_limits<double>::infinity(), high = -low;
  for (const double value : values) {
    if (!std::isfinite(value) || (scale == Scale::logarithmic && value <= 0)) continue;
    low = std::min(low, value);
    high = std::max(high, value);
  }
  if (low > high) low = scale == Scale::logarithmic ? 0.1 : 0, high = 1;
  if (scale == Scale::logarithmic) {
    low_ = std::floor(std::log10(low) + rounding::same);
    high_ = std::max(std::ceil(std::log10(high) - rounding::same), low_ + 1);
    make_decades(tick_count);
    return;
  }
  const double size = std::max(std::abs(low), std::abs(high));
  if (high - low <= rounding::same * size) {
    const double around = size > 0 ? 0.05 * size : 1;
    low -= around;
    high += around;
  }
  low_ = low - margin * (high - low);
  high_ = high + margin * (high - low);
  make_linear_ticks(tick_count);
}

Axis::Axis(double low, double high, int tick_count) : scale_(Scale::linear), low_(low), high_(high) {
  make_linear_ticks(tick_count);
}

double Axis::fraction(double value) const {
  if (scale_ == Scale::logarithmic) value = value > 0 ? std::log10(value) : no_value;
  return (value - low_) / (high_ - low_);
}

void Axis::make_linear_ticks(int count) {
  const double step = round_step((high_ - low_) / std::max(count, 1));
  const int decimals = std::clamp(static_cast<int>(-std::floor(std::log10(step) + rounding::same)), 0, 12);
  for (double i = std::ceil(low_ / step - rounding::same); i * step <= high_ + rounding::same * step; ++i)
    ticks_.push_back({i * step, fmt::format("{:.{}f}", i == 0 ? 0.0 : i * step, decimals)});
}

void Axis::make_decades(int count) {
  const int stride = std::max(1, static_cast<int>(std::ceil((high_ - low_) / std::max(count, 1))));
  for (int exponent = static_cast<int>(low_); exponent <= static_cast<int>(high_); exponent += stride)
    ticks_.push_back({std::pow(10.0, exponent), power_of_ten(exponent)});
}

}  // namespace sprekk
