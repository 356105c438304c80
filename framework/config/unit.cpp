#include "framework/config/unit.hpp"

#include <algorithm>
#include <cctype>
#include <charconv>
#include <cmath>
#include <numbers>

#include "framework/config/input_error.hpp"

namespace sprekk {
namespace {

constexpr std::size_t longest_unit = 80;
constexpr double greatest_power = 12;
const char* const time_variable = "t";  ///< of expressions, where it is no tonne

struct NamedUnit {
  const char* name;
  Unit unit;
  bool takes_prefix;
};

// Exponents of m, kg, s, K, rad. The darcy is 1 cm^2 cP/(s atm) = 1e-7/101325 m^2; the year is the Julian one.
const std::array<NamedUnit, 24> named_units = {{
    {"m", {1, {{1, 0, 0, 0, 0}}}, true},
    {"g", {1e-3, {{0, 1, 0, 0, 0}}}, true},
    {"t", {1e3, {{0, 1, 0, 0, 0}}}, false},
    {"s", {1, {{0, 0, 1, 0, 0}}}, true},
    {"min", {60, {{0, 0, 1, 0, 0}}}, false},
    {"h", {3600, {{0, 0, 1, 0, 0}}}, false},
    {"d", {86400, {{0, 0, 1, 0, 0}}}, false},
    {"day", {86400, {{0, 0, 1, 0, 0}}}, false},
    {"year", {365.25 * 86400, {{0, 0, 1, 0, 0}}}, false},
    {"K", {1, {{0, 0, 0, 1, 0}}}, true},
    {"rad", {1, {{0, 0, 0, 0, 1}}}, true},
    {"deg", {std::numbers::pi / 180, {{0, 0, 0, 0, 1}}}, false},
    {"°", {std::numbers::pi / 180, {{0, 0, 0, 0, 1}}}, false},
    {"Hz", {1, {{0, 0, -1, 0, 0}}}, true},
    {"N", {1, {{1, 1, -2, 0, 0}}}, true},
    {"Pa", {1, {{-1, 1, -2, 0, 0}}}, true},
    {"bar", {1e5, {{-1, 1, -2, 0, 0}}}, true},
    {"atm", {101325, {{-1, 1, -2, 0, 0}}}, false},
    {"J", {1, {{2, 1, -2, 0, 0}}}, true},
    {"W", {1, {{2, 1, -3, 0, 0}}}, true},
    {"P", {0.1, {{-1, 1, -1, 0, 0}}}, true},
    {"l", {1e-3, {{3, 0, 0, 0, 0}}}, true},
    {"D", {1e-7 / 101325, {{2, 0, 0, 0, 0}}}, true},
    {"%", {1e-2, {{0, 0, 0, 0, 0}}}, false},
}};

/// What other texts call a unit.
struct Alias {
  const char* name;
  const char* unit;
};
const std::array<Alias, 16> aliases = {{{"yr", "year"},
                                        {"yrs", "year"},
                                        {"a", "year"},
                                        {"y", "year"},
                                        {"hr", "h"},
                                        {"hrs", "h"},
                                        {"hour", "h"},
                                        {"hours", "h"},
                                        {"sec", "s"},
                                        {"secs", "s"},
                                        {"seconds", "s"},
                                        {"minute", "min"},
                                        {"minutes", "min"},
                                        {"metre", "m"},
                                        {"meter", "m"},

                                        {"degrees", "deg"}}};

struct Prefix {
  const char* name;
  double scale;
};
const std::array<Prefix, 10> prefixes = {{{"n", 1e-9},
                                          {"u", 1e-6},
                                          {"µ", 1e-6},
                                          {"μ", 1e-6},
                                          {"m", 1e-3},
                                          {"c", 1e-2},
                                          {"d", 1e-1},
                                          {"k", 1e3},
                                          {"M", 1e6},
                                          {"G", 1e9}}};

std::vector<std::string> common_names() {
  std::vector<std::string> names = {"kPa", "MPa", "GPa", "mm", "cm", "km",  "um",  "ms",   "kg",    "kN",
                                    "MN",  "kJ",  "mD",  "ml", "cP", "m^2", "m^3", "Pa*s", "mPa*s", "m^2/s"};
  for (const NamedUnit& named : named_units) names.emplace_back(named.name);
  return names;
}

const Unit* named_unit(const std::string& name) {
  const auto found =
      std::find_if(named_units.begin(), named_units.end(), [&](const NamedUnit& named) { return name == named.name; });
  return found == named_units.end() ? nullptr : &found->unit;
}

Unit unit_of_name(const std::string& name) {
  if (const Unit* whole = named_unit(name)) return *whole;  // before prefixes: "min" is a minute
  for (const Prefix& prefix : prefixes) {
    if (name.rfind(prefix.name, 0) != 0) continue;
    const std::string rest = name.substr(std::string(prefix.name).size());
    for (const NamedUnit& named : named_units) {
      if (named.takes_prefix && rest == named.name) return {prefix.scale * named.unit.scale, named.unit.dimension};
    }
  }
  for (const char* degrees : {"C", "F", "degC", "degF", "°C", "°F", "celsius", "Celsius", "fahrenheit", "Fahrenheit"})
    if (name == degrees)
      throw UnitProblem{"unknown unit " + quoted(name),
                        "temperatures are in K, since a unit is a factor and has no zero of its own",
                        "write 353.15 K for 80 degrees Celsius"};
  const std::string nearest = nearest_unit(name);
  throw UnitProblem{"unknown unit " + quoted(name),
                    "units are m g s min h d day year K rad deg Hz N Pa bar J W P l D %, with prefixes n u m c d k M G",
                    nearest.empty() ? "" : "did you mean " + quoted(nearest) + "?"};
}

/// unit = factor (('*' | '/') factor)*,  factor = base ['^' power],  base = '1' | name | '(' unit ')',
/// power = number | '(' number '/' number ')'.
class UnitParser {
 public:
  explicit UnitParser(const std::string& text) : text_(text) {}

  Unit parse() {
    const Unit unit = product();
    skip_spaces();
    if (position_ == text_.size()) return unit;
    if (text_[position_] == ')') fail("there is one ')' too many");
    fail("an operator is missing before " + quoted(text_.substr(position_)), "products are written with '*': Pa*s");
  }

  /// The length of the longest product of units that the text begins with, as expressions have them.
  std::size_t longest_prefix() {
    is_in_expression_ = true;
    std::size_t end = 0;
    try {
      do {
        factor();
        end = position_;
      } while (accept('*') || accept('/'));
    } catch (const UnitProblem&) {
      // What follows is no unit.
    }
    return end;
  }

 private:
  [[noreturn]] void fail(const std::string& why, const std::string& suggestion = "") const {
    throw UnitProblem{"malformed unit " + quoted(text_), why, suggestion};
  }

  void skip_spaces() {
    while (position_ < text_.size() && text_[position_] == ' ') ++position_;
  }

  bool accept(char wanted) {
    skip_spaces();
    if (position_ == text_.size() || text_[position_] != wanted) return false;
    ++position_;
    return true;
  }

  Unit product() {
    Unit result = factor();
    for (;;) {
      if (accept('*')) {
        result = result * factor();
      } else if (accept('/')) {
        result = result * factor().to_the(-1);
      } else {
        return result;
      }
    }
  }

  Unit factor() {
    const Unit unit = base();
    return accept('^') ? unit.to_the(power()) : unit;
  }

  Unit base() {
    if (accept('(')) {
      const Unit unit = product();
      if (!accept(')')) fail("a ')' is missing");
      return unit;
    }
    skip_spaces();
    const std::size_t begin = position_;
    while (position_ < text_.size() && is_name_byte(text_[position_])) ++position_;
    const std::string name = text_.substr(begin, position_ - begin);
    if (name == "1" && !(is_in_expression_ && (begin > 0 || !followed_by('/')))) return {};
    if (is_in_expression_ && (name == time_variable || followed_by('('))) fail("it is a variable or a function");
    if (name.empty()) fail("a unit is missing at its character " + std::to_string(begin + 1));
    if (std::isdigit(static_cast<unsigned char>(name[0])) != 0) {
      fail("the number " + name + " stands in the unit", "powers are written with '^': m^2, m^(1/2)");
    }
    return unit_of_name(name);
  }

  static bool is_name_byte(char c) {
    const auto byte = static_cast<unsigned char>(c);
    return std::isalnum(byte) != 0 || byte == '%' || byte == '_' || byte >= 0x80;
  }

  double power() {
    if (!accept('(')) return number();
    double result = number();
    if (accept('/')) result /= number();
    if (!accept(')')) fail("a ')' is missing");
    return result;
  }

  double number() {
    skip_spaces();
    if (position_ < text_.size() && text_[position_] == '+') ++position_;
    double value = 0;
    const char* end_of_text = text_.data() + text_.size();
    const auto [end, error] = std::from_chars(text_.data() + position_, end_of_text, value, std::chars_format::fixed);
    if (error != std::errc{} || !(std::abs(value) <= greatest_power)) fail("a power must be a number from -12 to 12");
    position_ = static_cast<std::size_t>(end - text_.data());
    return value;
  }

  bool followed_by(char next) const {
    const std::size_t at = text_.find_first_not_of(' ', position_);
    return at != std::string::npos && text_[at] == next;
  }

  const std::string& text_;
  std::size_t position_ = 0;
  bool is_in_expression_ = false;
};

}  // namespace

Unit Unit::operator*(const Unit& other) const {
  Unit result{scale * other.scale, dimension};
  for (std::size_t i = 0; i < result.dimension.exponents.size(); ++i) {
    result.dimension.exponents[i] += other.dimension.exponents[i];
  }
  return result;
}

Unit Unit::to_the(double power) const {
  Unit result{scale == 1 ? 1.0 : std::pow(scale, power), dimension};
  if (power == -1) result.scale = 1 / scale;
  for (double& exponent : result.dimension.exponents) exponent *= power;
  return result;
}

Unit parse_unit(const std::string& text) {
  if (text.empty()) return {};
  if (text.size() > longest_unit) throw UnitProblem{"malformed unit " + quoted(text), "it is too long", ""};
  return UnitParser(text).parse();
}

std::string nearest_unit(const std::string& name) {
  const auto alias = std::ranges::find_if(aliases, [&](const Alias& other) { return name == other.name; });
  return alias == aliases.end() ? nearest_name(name, common_names()) : alias->unit;
}

bool is_unit(const std::string& text) { return have_one_dimension(text, text); }

bool have_one_dimension(const std::string& unit, const std::string& other) {
  try {
    return parse_unit(unit).dimension == parse_unit(other).dimension;
  } catch (const UnitProblem&) {
    return false;
  }
}

std::vector<std::string> units_like(const std::string& unit) {
  if (unit == "rad") return {"deg"};
  const std::size_t end =
      std::ranges::find_if_not(unit, [](unsigned char c) { return std::isalpha(c) != 0; }) - unit.begin();
  const std::string first = unit.substr(0, end), behind = unit.substr(end);
  std::vector<std::string> like;
  for (const NamedUnit& named : named_units) {
    const std::string name = named.name;
    if (!named.takes_prefix || !first.ends_with(name) || !have_one_dimension(first, name)) continue;
    for (const std::string prefix : {"u", "m", "", "k", "M", "G"})
      if (prefix + name != first && (prefix != "u" || name == "m") && have_one_dimension(prefix + name, name))
        like.push_back(prefix + name + behind);
  }
  return like;
}

std::size_t unit_length(const std::string& text) { return UnitParser(text).longest_prefix(); }

const std::vector<std::pair<std::string, double>>& unit_constants() {
  static const std::vector<std::pair<std::string, double>> constants = [] {
    std::vector<std::pair<std::string, double>> result;
    const auto add = [&result](const std::string& name, double scale) {
      const bool is_word = std::ranges::all_of(name, [](unsigned char c) { return std::isalpha(c) != 0; });
      if (is_word && name != time_variable) result.emplace_back(name, scale);
    };
    for (const NamedUnit& named : named_units) {
      add(named.name, named.unit.scale);
      for (const Prefix& prefix : prefixes)
        if (const std::string name = std::string(prefix.name) + named.name; named.takes_prefix && !named_unit(name))
          add(name, prefix.scale * named.unit.scale);
    }
    return result;
  }();
  return constants;
}

}  // namespace sprekk
