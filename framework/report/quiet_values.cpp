#include "framework/report/quiet_values.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <iterator>

#include "framework/picture/display_unit.hpp"
#include "framework/report/html.hpp"
#include "framework/round_off.hpp"

namespace sprekk {
namespace {

// What Newton's method, which stops at 1e-10 of the terms of an equation, leaves of a balance.
constexpr double far_below = 1e-10;

}  // namespace

double largest_size(const std::vector<double>& values) {
  double largest = 0;
  for (const double value : values)
    if (std::isfinite(value)) largest = std::max(largest, std::abs(value));
  return largest;
}

void SizesOfUnits::add(const std::string& unit, const std::vector<double>& values) {
  double& largest = largest_[unit];
  largest = std::max(largest, largest_size(values));
}

bool SizesOfUnits::are_far_below(const std::string& unit, const std::vector<double>& values) const {
  const auto largest = largest_.find(unit);
  if (unit.empty() || largest == largest_.end()) return false;
  const double size = largest_size(values);
  return size > 0 && size <= far_below * largest->second;
}

bool QuietValues::take(const std::string& name, const std::string& unit, const std::vector<double>& values) {
  if (sizes_.are_far_below(unit, values)) {
    far_below_.push_back(name + ", at most " + display_text(largest_size(values), unit));
    return true;
  }
  std::vector<double> finite;
  std::ranges::copy_if(values, std::back_inserter(finite), [](double value) { return std::isfinite(value); });
  if (finite.empty()) return false;
  const auto [low, high] = std::ranges::minmax(finite);
  if (high - low > rounding::same * largest_size(finite)) return false;
  constant_.push_back(name + " " + display_text(finite.back(), unit));
  return true;
}

std::string QuietValues::told() const {
  std::string text;
  if (!constant_.empty())
    text += html_paragraph(fmt::format("Not drawn, since constant: {}.", fmt::join(constant_, ", ")));
  if (!far_below_.empty())
    text += html_paragraph(fmt::format("Not drawn, since below {:.0e} of the largest value of their unit: {}.",
                                       far_below, fmt::join(far_below_, "; ")));
  return text;
}

}  // namespace sprekk
