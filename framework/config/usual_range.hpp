// The values that a parameter has as a rule, beside those that are possible.
#pragma once

#include <algorithm>
#include <functional>
#include <limits>
#include <string>

#include "framework/config/spec.hpp"

namespace sprekk {

/// An interval in SI units, and its source. A scene that gives a value outside of it gets a note.
struct UsualRange {
  double low = -std::numeric_limits<double>::infinity();
  double high = std::numeric_limits<double>::infinity();
  const char* source = "";
  /// Zero is usual: it leaves an effect out.
  bool contains(double value) const { return value == 0 || (value >= low && value <= high); }
  /// How far outside the value is; 0 inside.
  double distance(double value) const { return contains(value) ? 0 : std::max(low - value, value - high); }
};

/// Declares the usual range of a parameter that the spec has. Throws std::logic_error for a parameter that the spec
/// does not have.
void usually(const Spec& spec, const std::string& parameter, const UsualRange& range);
/// The same for maps that fulfil a condition: the usual range of what the parameter means there.
void usually(const Spec& spec, const std::string& parameter, const UsualRange& range,
             std::function<bool(const Node& map)> condition);
/// The usual range of a parameter, or nullptr.
const UsualRange* usual_range(const Spec& spec, const std::string& parameter);
/// The usual range of the parameter in this map, or nullptr.
const UsualRange* usual_range(const Spec& spec, const std::string& parameter, const Node& map);
UsualRange usual_angle();  ///< of a direction, rad: less than a full turn
/// "from 1e+05 to 2e+11 Pa".
std::string usual_text(const UsualRange& range, const std::string& unit);

}  // namespace sprekk
