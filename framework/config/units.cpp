#include "framework/config/units.hpp"

#include <fmt/format.h>

#include <cmath>

#include "framework/config/number.hpp"
#include "framework/config/quantity_scale.hpp"

namespace sprekk {

namespace {

std::string given_as(const std::string& name, const std::string& text) {
  return name.empty() ? quoted(text) : quoted(text) + " for " + quoted(name);
}

std::string needed(const std::string& unit) { return unit.empty() ? "a plain number" : unit; }

/// Stresses and stiffnesses of rock are rarely told in Pa.
std::string with_likely_units(const std::string& number, const std::string& unit) {
  const auto with = [&](const std::string& other) { return quoted(number + " " + other); };
  if (unit == "Pa") return with("MPa") + ", " + with("GPa") + " or " + with("Pa");
  return with(unit == "rad" ? "deg" : unit);
}

}  // namespace

double scale_to_si(const std::string& written, const std::string& unit, const std::string& whole, const Origin& where,
                   const std::string& name) {
  Unit given;
  try {
    given = parse_unit(written);
  } catch (const UnitProblem& problem) {
    throw InputError(where, problem.problem + " in " + quoted(whole) + (name.empty() ? "" : " for " + quoted(name)),
                     problem.why, problem.suggestion);
  }
  const Dimension wanted = parse_unit(unit).dimension;
  if (given.dimension == wanted) return given.scale;
  const std::string expected = unit.empty() ? "a plain number" : wanted.name() + ", in " + unit;
  throw InputError(
      where, given_as(name, whole) + " has the dimension of " + given.dimension.name(), "needed is " + expected,
      !unit.empty()                                    ? "give it in a unit like " + unit
      : given.dimension == parse_unit("rad").dimension ? "write its tangent: " + quoted("tan(" + whole + ")")
                                                       : "write the number without a unit");
}

double parse_quantity(const std::string& text, const std::string& unit, const Origin& where, const std::string& name) {
  require_plain_number(text, where, name);
  const std::string content = trimmed(text);
  const std::optional<LeadingNumber> number = leading_number(content);
  if (!number) {
    throw InputError(where, given_as(name, text) + " is not a number" + (unit.empty() ? "" : " with a unit"),
                     "needed is " + needed(unit));
  }
  if (!number->is_finite) {
    throw InputError(where, given_as(name, text) + " is not finite", "numbers lie between about 1e-308 and 1e308",
                     "write a number like 2.5e-3");
  }
  const std::string written = trimmed(content.substr(number->length));
  const bool needs_no_unit = unit.empty() || unit == "m" || number->value == 0;
  if (written.empty() && needs_no_unit) return number->value;
  if (written.empty()) {
    throw InputError(where, given_as(name, text) + " has no unit",
                     "needed is " + parse_unit(unit).dimension.name() + ", in " + unit + " or another unit of it",
                     "write " + with_likely_units(content, unit) + ", if that is what it is");
  }
  const double value = number->value * scale_to_si(written, unit, text, where, name);
  if (!std::isfinite(value)) throw InputError(where, given_as(name, text) + " is not finite", "in " + needed(unit));
  return value;
}

std::string quantity_text(double value, const std::string& unit) {
  return unit.empty() ? fmt::format("{}", value) : fmt::format("{} {}", value, unit);
}

}  // namespace sprekk
