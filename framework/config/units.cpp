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
  throw InputError(where, given_as(name, whole) + " has the dimension of " + given.dimension.name(),
                   "needed is " + expected,
                   unit.empty() ? "write the number without a unit" : "give it in a unit like " + unit);
}

void require_plain_number(const std::string& text, const Origin& where, const std::string& name) {
  const auto refuse = [&](const std::string& what, const std::string& why, const std::string& advice) {
    throw InputError(where, given_as(name, text) + " " + what, why, advice);
  };
  const std::string content = trimmed(text);
  if (const std::string other = with_exponent_e(content); !other.empty())
    refuse("has no number that can be read", "powers of ten are written with 'e'", "write " + quoted(other));
  const std::optional<LeadingNumber> number = leading_number(content);
  const bool has_comma = number && number->length + 1 < content.size() && content[number->length] == ',';
  if (has_comma && std::isdigit(static_cast<unsigned char>(content[number->length + 1])) != 0)
    refuse("has a decimal comma", "", "write decimals with a point");
  for (const auto& [minus, name_of_it] : {std::pair("\u2212", "minus sign"), std::pair("\u2013", "dash")})
    if (content.find(minus) != std::string::npos)
      refuse(std::string("has a ") + name_of_it + " that is no '-'", "it looks like one, as texts are set", "type '-'");
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
                     "write " + quoted(content + " " + (unit == "rad" ? "deg" : unit)) + ", if that is what it is");
  }
  const double value = number->value * scale_to_si(written, unit, text, where, name);
  if (!std::isfinite(value)) throw InputError(where, given_as(name, text) + " is not finite", "in " + needed(unit));
  return value;
}

std::string quantity_text(double value, const std::string& unit) {
  return unit.empty() ? fmt::format("{}", value) : fmt::format("{} {}", value, unit);
}

}  // namespace sprekk
