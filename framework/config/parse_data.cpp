// Distinguishes quantities from expressions, and separates expressions from the unit behind them.
#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cctype>
#include <optional>

#include "framework/config/expression.hpp"
#include "framework/config/number.hpp"
#include "framework/config/quantity_scale.hpp"
#include "framework/config/state.hpp"
#include "framework/config/units.hpp"

namespace sprekk {
namespace {

bool begins_operand(char c) {
  const auto byte = static_cast<unsigned char>(c);
  return std::isalnum(byte) != 0 || byte == '.' || byte == '_' || byte == '%' || byte >= 0x80;
}

bool is_operand_byte(char c) { return begins_operand(c) && c != '%'; }

/// An expression split into what is evaluated and the unit that follows.
struct Split {
  std::string expression, unit;
  bool is_single_operand = true;  ///< then the unit can only belong to the whole expression
};

/// Finds the unit behind an expression: it begins where, outside parentheses, one operand follows another without an
/// operator.
Split split_off_unit(const std::string& text) {
  Split split;
  int depth = 0;
  bool after_operand = false;
  for (std::size_t i = 0; i < text.size(); ++i) {
    const char c = text[i];
    if (c == '(') {
      ++depth;
      after_operand = false;
    } else if (c == ')') {
      --depth;
      after_operand = true;
    } else if (depth > 0 || c == ' ' || c == '\t' || c == '\n') {
      continue;
    } else if (begins_operand(c)) {
      if (after_operand) {
        split.unit = trimmed(text.substr(i));
        split.expression = trimmed(text.substr(0, i));
        return split;
      }
      while (i + 1 < text.size() && is_operand_byte(text[i + 1])) ++i;
      after_operand = true;
    } else {
      split.is_single_operand = false;
      after_operand = false;
    }
  }
  split.expression = text;
  return split;
}

/// Whether the text is a number with at most a unit behind it: "40 GPa" and "5e-3", but not "2*x" or "5 MPa + 2 bar".
bool is_quantity(const std::string& text) {
  const std::optional<LeadingNumber> number = leading_number(text);
  if (!number) return false;
  const std::string rest = trimmed(text.substr(number->length));
  if (rest.empty()) return true;
  const std::string operators = "+-*/^<>=!&|?),";
  if (operators.find(rest[0]) != std::string::npos) return false;
  if (is_unit(rest)) return true;
  const std::string behind = trimmed(rest.substr(unit_length(rest)));
  return behind.empty() || behind.size() == rest.size() || operators.find(behind[0]) == std::string::npos;
}

/// The unit in names that an expression knows.
std::string in_words(std::string unit) {
  for (const auto& [sign, word] :
       {std::pair("°", "deg"), std::pair("µ", "u"), std::pair("μ", "u"), std::pair("%", "0.01")})
    for (std::size_t at = unit.find(sign); at != std::string::npos; at = unit.find(sign, at))
      unit.replace(at, std::string(sign).size(), word);
  return unit;
}

/// The expression with a product for each number that has a unit behind it: "t < 12 h" becomes "t < (12*h)".
std::string with_products(const std::string& text) {
  std::string result;
  bool in_word = false;
  for (std::size_t i = 0; i < text.size();) {
    const bool is_digit = std::isdigit(static_cast<unsigned char>(text[i])) != 0 || text[i] == '.';
    const std::optional<LeadingNumber> number =
        is_digit && !in_word ? leading_number(text.substr(i)) : std::optional<LeadingNumber>();
    if (!number) {
      in_word = is_operand_byte(text[i]);
      result += text[i++];
      continue;
    }
    const std::string digits = text.substr(i, number->length), rest = text.substr(i + number->length);
    const std::size_t spaces = std::min(rest.find_first_not_of(' '), rest.size());
    const bool begins_unit = spaces < rest.size() && begins_operand(rest[spaces]);
    const std::size_t unit = begins_unit ? unit_length(rest.substr(spaces)) : 0;
    result += unit == 0 ? digits : "(" + digits + "*" + in_words(rest.substr(spaces, unit)) + ")";
    i += number->length + (unit == 0 ? 0 : spaces + unit);
    in_word = unit == 0;
  }
  return result;
}

/// Refuses an expression that has not the dimension of `unit`, or lacks a unit. `whole`: as it is written.
void require_unit(const std::string& expression, const std::string& unit, const std::string& whole, const Origin& where,
                  const std::string& name, const StateVariables& state) {
  const Dimension wanted = parse_unit(unit).dimension;
  const LackOfUnit lack = lack_of_unit(expression, wanted, where, state);
  if (lack == LackOfUnit::none) return;
  const std::string what = quoted(whole) + (name.empty() ? "" : " for " + quoted(name));
  const std::string needed =
      "needed is " + (unit.empty() ? wanted.name() : wanted.name() + ", in " + unit + " or another unit of it");
  if (lack == LackOfUnit::of_a_term)
    throw InputError(
        where, what + " has another unit, or a term without one", needed,
        unit.empty() ? "divide each quantity by its unit: t/day" : "multiply each of its terms by its unit");
  throw InputError(where, what + " has no unit", needed,
                   "write " + quoted("(" + whole + ") " + unit) + ", if that is what it is");
}

}  // namespace

std::string si_unit(const Dimension& dimension) {
  for (const char* known :
       {"", "m", "s", "K", "Pa", "m/s", "1/s", "1/m", "1/Pa", "m^2", "m^3", "Pa*s", "Pa*m", "Pa*m/s", "Pa/s", "N", "J"})
    if (parse_unit(known).dimension == dimension) return known;
  constexpr std::array base = {"m", "kg", "s", "K", "rad"};
  std::string product;
  for (std::size_t i = 0; i < base.size(); ++i)
    if (const double exponent = dimension.exponents[i]; exponent != 0)
      product += fmt::format("{}{}^{}", product.empty() ? "" : "*", base[i], exponent);
  return product;
}

std::string unit_of_data(const std::string& text, const Origin& where, const std::string& name,
                         const StateVariables& state) {
  const Split split = split_off_unit(with_products(trimmed(text)));
  std::optional<Dimension> dimension;
  if (split.unit.empty())
    dimension = dimension_of(split.expression, where, state);
  else if (is_unit(split.unit))
    dimension = parse_unit(split.unit).dimension;
  if (dimension) return si_unit(*dimension);
  throw InputError(where, quoted(text) + " for " + quoted(name) + " has no unit of its own",
                   "its terms have different units, or one of them has none", "multiply each of its terms by its unit");
}

Data parse_data(const std::string& text, const std::string& unit, const Origin& where, const std::string& name) {
  const StateVariables& state = ReadsFormula::variables();
  const std::string content = trimmed(text);
  if (content.empty()) throw InputError(where, (name.empty() ? "the datum" : quoted(name)) + " is empty");
  require_plain_number(content, where, name);
  if (is_quantity(content)) return parse_quantity(content, unit, where, name);
  const Split split = split_off_unit(with_products(content));
  if (split.unit.empty()) {
    require_unit(split.expression, unit, content, where, name, state);
    return parse_expression(split.expression, 1, where, name, state);
  }
  const double scale = scale_to_si(split.unit, unit, content, where, name);
  if (!split.is_single_operand) {
    throw InputError(where, "malformed expression " + quoted(text),
                     "it is not clear what the unit " + quoted(split.unit) + " belongs to",
                     "write " + quoted("(" + split.expression + ") " + split.unit) + " or multiply by the unit");
  }
  if (lack_of_unit(split.expression, {}, where, state) != LackOfUnit::none)
    throw InputError(where, quoted(text) + (name.empty() ? "" : " for " + quoted(name)) + " has units twice",
                     "the unit " + quoted(split.unit) + " behind the expression multiplies those inside",
                     "keep one of them");
  return parse_expression(split.expression, scale, where, name, state);
}

}  // namespace sprekk
