#include "framework/compare/scale.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

#include "framework/picture/display_unit.hpp"
#include "framework/round_off.hpp"

namespace sprekk {
void ValueRange::add(double value) {
  if (!std::isfinite(value)) return;
  low_ = is_empty_ ? value : std::min(low_, value);
  high_ = is_empty_ ? value : std::max(high_, value);
  is_empty_ = false;
}

void ValueRange::add(const ValueRange& other) {
  if (other.is_empty_) return;
  add(other.low_);
  add(other.high_);
}

double ValueRange::size() const { return std::max(std::abs(low_), std::abs(high_)); }

double scale_of(double width, double size) { return width >= rounding::far_above * size ? width : size; }

std::string scale_family(const std::string& column) {
  static const std::array<const char*, 17> endings = {
      ".n",    ".t",     ".x", ".y",  ".xx",     ".yy",       ".xy",      ".normal",       ".tangential",
      ".plus", ".minus", "_I", "_II", "_stored", "_injected", "_outflow", "_balance_error"};
  const ColumnName name = column_name(column);
  for (const std::string ending : endings)
    if (name.quantity.ends_with(ending))
      return name.quantity.substr(0, name.quantity.size() - ending.size()) + " [" + name.unit;
  return column;
}

double relative(double difference, double scale) {
  if (difference == 0) return 0;
  return scale > 0 ? difference / scale : std::numeric_limits<double>::infinity();
}

}  // namespace sprekk
