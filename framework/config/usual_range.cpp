#include "framework/config/usual_range.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <map>
#include <numbers>
#include <stdexcept>

namespace sprekk {
namespace {

/// By the name of the spec and that of the parameter: a spec is made anew for each map that it reads.
std::map<std::pair<std::string, std::string>, UsualRange>& ranges() {
  static std::map<std::pair<std::string, std::string>, UsualRange> all;
  return all;
}

}  // namespace

void usually(const Spec& spec, const std::string& parameter, const UsualRange& range) {
  if (std::ranges::none_of(spec.parameters(), [&](const Parameter& known) { return known.name == parameter; }))
    throw std::logic_error(spec.name() + " has no parameter '" + parameter + "' that could have a usual range");
  ranges()[{spec.name(), parameter}] = range;
}

const UsualRange* usual_range(const Spec& spec, const std::string& parameter) {
  const auto found = ranges().find({spec.name(), parameter});
  return found == ranges().end() ? nullptr : &found->second;
}

UsualRange usual_angle() { return {-2 * std::numbers::pi, 2 * std::numbers::pi, "a full turn"}; }

std::string usual_text(const UsualRange& range, const std::string& unit) {
  return fmt::format("from {:.4g} to {:.4g}{}{}", range.low, range.high, unit.empty() ? "" : " ", unit);
}

}  // namespace sprekk
