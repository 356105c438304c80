#include "framework/config/units.hpp"

#include <fmt/format.h>

#include <cctype>
#include <cmath>
#include <regex>

#include "framework/config/number.hpp"
#include "framework/config/quantity_scale.hpp"

namespace sprekk {

namespace {

/// Something that another program, or a reader, takes for a number or a unit.
struct Misspelling {
  std::regex pattern;
  const char* has;  ///< "'1e-17 m**2' for 'permeability' has …"
  const char* why;
  const char* replacement;  ///< of the pattern
};

const std::vector<Misspelling>& misspellings() {
  static const std::vector<Misspelling> all = {
      {std::regex(R"(\*\*)"), "'**'", "powers are written with '^'", "^"},
      {std::regex(R"(^([-+]?[0-9.]+)\s+([eE][-+]?[0-9]+))"), "a blank in its number", "", "$1$2"},
      {std::regex(R"(^([-+]?[0-9.]+)\s*[*x]\s*10\^\(?([-+]?[0-9]+)\)?(?=\s*[A-Za-z]))"),
       "a power of ten before its unit", "powers of ten are written with 'e'", "$1e$2"},
      {std::regex(R"(^10\^\(?([-+]?[0-9]+)\)?(?=\s*[A-Za-z]))"), "a power of ten before its unit",
       "powers of ten are written with 'e'", "1e$1"},
      {std::regex(R"((^|[^A-Za-z0-9_.^])([cdkmu]?m)([23])(?![A-Za-z0-9_.(]))"), "a unit without '^'",
       "powers are written with '^'", "$1$2^$3"},
      {std::regex(R"((^|[^A-Za-z0-9_.^])cc(?![A-Za-z0-9_.(]))"), "the unit 'cc'", "powers are written with '^'",
       "$1cm^3"}};
  return all;
}

}  // namespace

void require_plain_number(const std::string& text, const Origin& where, const std::string& name) {
  const auto refuse = [&](const std::string& what, const std::string& why, const std::string& advice) {
    throw InputError(where, quoted(text) + (name.empty() ? "" : " for " + quoted(name)) + " " + what, why, advice);
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
  for (const char* mark : {"\u201c", "\u201d", "\u201e", "\u2018", "\u2019"})
    if (content.find(mark) != std::string::npos)
      refuse(std::string("has a quotation mark ") + mark, "texts are set with such marks, and YAML does not know them",
             "type \"");
  constexpr std::size_t longest = 200;  // characters: std::regex needs a part of the stack for each
  if (content.size() > longest) return;
  for (const Misspelling& one : misspellings())
    if (std::regex_search(content, one.pattern))
      refuse(std::string("has ") + one.has, one.why,
             "write " + quoted(std::regex_replace(content, one.pattern, one.replacement)));
}

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
