#include "framework/config/range.hpp"

#include <fmt/format.h>

namespace sprekk {

bool Range::contains(double value) const {
  const bool above = low_allowed ? value >= low : value > low;
  const bool below = high_allowed ? value <= high : value < high;
  return above && below;
}

std::string Range::text() const {
  const bool has_low = low > -std::numeric_limits<double>::infinity();
  const bool has_high = high < std::numeric_limits<double>::infinity();
  const std::string above = fmt::format("{} {}", low_allowed ? ">=" : ">", low);
  const std::string below = fmt::format("{} {}", high_allowed ? "<=" : "<", high);
  if (has_low && has_high) {
    return low_allowed && high_allowed ? fmt::format("from {} to {}", low, high) : above + " and " + below;
  }
  return has_low ? above : has_high ? below : "";
}

Range positive() { return {.low = 0, .low_allowed = false}; }
Range non_negative() { return {.low = 0}; }
Range between(double low, double high) { return {.low = low, .high = high}; }
Range strictly_between(double low, double high) {
  return {.low = low, .high = high, .low_allowed = false, .high_allowed = false};
}

}  // namespace sprekk
