// Distinguishes quantities from expressions, and separates expressions from the unit behind them.
#include <cctype>

#include "framework/config/expression.hpp"
#include "framework/config/number.hpp"
#include "framework/config/quantity_scale.hpp"
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

/// Whether the text is a number with at most a unit behind it: "40 GPa" and "5e-3", but not "2*x".
bool is_quantity(const std::string& text) {
  const std::optional<LeadingNumber> number = leading_number(text);
  if (!number) return false;
  const std::size_t next = text.find_first_not_of(' ', number->length);
  if (next == std::string::npos) return true;
  return std::string("+-*/^<>=!&|?),").find(text[next]) == std::string::npos;
}

/// Whether a number has a comma where the point belongs: "1,5 mPa*s".
bool has_decimal_comma(const std::string& text) {
  const std::optional<LeadingNumber> number = leading_number(text);
  if (!number || number->length + 1 >= text.size() || text[number->length] != ',') return false;
  return std::isdigit(static_cast<unsigned char>(text[number->length + 1])) != 0;
}

/// Refuses a quantity without a unit; a length is in m then, and a plain number needs none.
void require_unit(const std::string& expression, const std::string& unit, const Origin& where,
                  const std::string& name) {
  const Dimension wanted = parse_unit(unit).dimension;
  if (unit == "m" || wanted == Dimension{}) return;
  const LackOfUnit lack = lack_of_unit(expression, wanted, where);
  if (lack == LackOfUnit::none) return;
  const std::string whole = quoted(expression) + (name.empty() ? "" : " for " + quoted(name));
  const std::string needed = "needed is " + wanted.name() + ", in " + unit + " or another unit of it";
  if (lack == LackOfUnit::of_a_term)
    throw InputError(where, whole + " has another unit, or a term without one", needed,
                     "multiply each of its terms by its unit");
  throw InputError(where, whole + " has no unit", needed,
                   "write " + quoted("(" + expression + ") " + unit) + ", if that is what it is");
}

}  // namespace

Data parse_data(const std::string& text, const std::string& unit, const Origin& where, const std::string& name) {
  const std::string content = trimmed(text);
  if (content.empty()) throw InputError(where, (name.empty() ? "the datum" : quoted(name)) + " is empty");
  if (is_quantity(content)) return parse_quantity(content, unit, where, name);
  if (has_decimal_comma(content)) {
    throw InputError(where, quoted(text) + (name.empty() ? "" : " for " + quoted(name)) + " has a decimal comma", "",
                     "write decimals with a point");
  }
  const Split split = split_off_unit(content);
  if (split.unit.empty()) {
    require_unit(split.expression, unit, where, name);
    return parse_expression(split.expression, 1, where);
  }
  const double scale = scale_to_si(split.unit, unit, content, where, name);
  if (!split.is_single_operand) {
    throw InputError(where, "malformed expression " + quoted(text),
                     "it is not clear what the unit " + quoted(split.unit) + " belongs to",
                     "write " + quoted("(" + split.expression + ") " + split.unit) + " or multiply by the unit");
  }
  return parse_expression(split.expression, scale, where);
}

}  // namespace sprekk
