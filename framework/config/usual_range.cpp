#include "framework/config/usual_range.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <map>
#include <numbers>
#include <stdexcept>

namespace sprekk {
namespace {

/// The name of a spec and that of a parameter: a spec is made anew for each map that it reads.
using Key = std::pair<std::string, std::string>;

struct Conditional {
  UsualRange range;
  std::function<bool(const Node&)> condition;
};

std::map<Key, UsualRange>& ranges() {
  static std::map<Key, UsualRange> all;
  return all;
}

std::map<Key, Conditional>& conditional_ranges() {
  static std::map<Key, Conditional> all;
  return all;
}

void require_parameter(const Spec& spec, const std::string& parameter) {
  if (std::ranges::none_of(spec.parameters(), [&](const Parameter& known) { return known.name == parameter; }))
    throw std::logic_error(spec.name() + " has no parameter '" + parameter + "' that could have a usual range");
}

}  // namespace

void usually(const Spec& spec, const std::string& parameter, const UsualRange& range) {
  require_parameter(spec, parameter);
  ranges()[{spec.name(), parameter}] = range;
}

void usually(const Spec& spec, const std::string& parameter, const UsualRange& range,
             std::function<bool(const Node& map)> condition) {
  require_parameter(spec, parameter);
  conditional_ranges()[{spec.name(), parameter}] = {range, std::move(condition)};
}

const UsualRange* usual_range(const Spec& spec, const std::string& parameter) {
  const auto found = ranges().find({spec.name(), parameter});
  return found == ranges().end() ? nullptr : &found->second;
}

const UsualRange* usual_range(const Spec& spec, const std::string& parameter, const Node& map) {
  const auto found = conditional_ranges().find({spec.name(), parameter});
  const bool holds = found != conditional_ranges().end() && found->second.condition(map);
  return holds ? &found->second.range : usual_range(spec, parameter);
}

UsualRange usual_angle() { return {-2 * std::numbers::pi, 2 * std::numbers::pi, "a full turn"}; }

std::string usual_text(const UsualRange& range, const std::string& unit) {
  return fmt::format("from {:.4g} to {:.4g}{}{}", range.low, range.high, unit.empty() ? "" : " ", unit);
}

}  // namespace sprekk
