#include "framework/formula/parser.hpp"

#include <algorithm>
#include <cctype>
#include <charconv>
#include <cmath>
#include <numbers>
#include <optional>

namespace sprekk::formula {
namespace {

constexpr std::size_t longest_formula = 4000;  // characters: nobody reads a longer one
constexpr int deepest_nesting = 500;           // of operands: each needs a part of the stack

/// What binds more tightly comes later; a choice is c ? a : b.
struct Priority {
  enum Value : int { choice, either, both, comparison, sum, product, sign, power };
};

struct Infix {
  const char* text;
  int priority;
  Operation operation;
};
/// Longer texts first.
const Infix infixes[] = {{"||", Priority::either, Operation::either},
                         {"&&", Priority::both, Operation::both},
                         {"<=", Priority::comparison, Operation::less_equal},
                         {">=", Priority::comparison, Operation::greater_equal},
                         {"==", Priority::comparison, Operation::equal},
                         {"!=", Priority::comparison, Operation::not_equal},
                         {"<", Priority::comparison, Operation::less},
                         {">", Priority::comparison, Operation::greater},
                         {"+", Priority::sum, Operation::add},
                         {"-", Priority::sum, Operation::subtract},
                         {"*", Priority::product, Operation::multiply},
                         {"/", Priority::product, Operation::divide},
                         {"^", Priority::power, Operation::raise}};

/// Functions of several values, each with the least and the largest number of them.
struct Several {
  const char* name;
  int least, most;
  Operation operation;
};
const Several functions_of_several[] = {{"atan2", 2, 2, Operation::arc_tangent_of_two},
                                        {"pow", 2, 2, Operation::raise},
                                        {"if", 3, 3, Operation::select},
                                        {"min", 1, 1000, Operation::minimum},
                                        {"max", 1, 1000, Operation::maximum}};

std::string quoted(const std::string& text) { return "'" + text + "'"; }

std::string trimmed(const std::string& text) {
  const std::size_t begin = text.find_first_not_of(" \t\r\n");
  if (begin == std::string::npos) return "";
  return text.substr(begin, text.find_last_not_of(" \t\r\n") - begin + 1);
}

/// A number at the beginning of a text.
struct Leading {
  double value = 0;
  std::size_t length = 0;  ///< 0 where there is none
};
Leading leading_number(const char* begin, const char* end) {
  Leading number;
  const auto [behind, error] = std::from_chars(begin, end, number.value);
  if (error == std::errc{}) number.length = static_cast<std::size_t>(behind - begin);
  return number;
}

bool begins_name(char c) { return std::isalpha(static_cast<unsigned char>(c)) != 0 || c == '_'; }
bool is_name_byte(char c) { return std::isalnum(static_cast<unsigned char>(c)) != 0 || c == '_'; }

const NamedFunction* function_of_one(const std::string& name) {
  for (const NamedFunction& function : functions_of_one())
    if (name == function.name) return &function;
  return nullptr;
}

const Several* function_of_several(const std::string& name) {
  const auto found = std::ranges::find_if(functions_of_several, [&](const Several& f) { return name == f.name; });
  return found == std::end(functions_of_several) ? nullptr : found;
}

/// Recursive descent by priorities; each operand is a call.
class Parser {
 public:
  Parser(const std::string& text, const Names& names) : text_(text), names_(names) {}

  Parsed parse() {
    if (text_.size() > longest_formula) fail("it is longer than " + std::to_string(longest_formula) + " characters");
    expression(Priority::choice);
    if (const std::string rest = next_token(); rest == ",")
      fail("it has several values, separated by commas", "write decimals with a point");
    else if (rest == ")")
      fail_at(rest, ", where a value or an operator belongs");
    else if (rest == "?" || rest == ":")
      fail("its '?' and ':' do not belong together", "write 'condition ? value : other value'");
    else if (!rest.empty())
      fail_at(rest, " without an operator between them", "write '*' for a product");
    return std::move(parsed_);
  }

 private:
  [[noreturn]] void fail(const std::string& why, const std::string& suggestion = "") const {
    throw Problem{"", why, suggestion};
  }
  void refuse_unbalanced() const {
    const auto opened = std::ranges::count(text_, '('), closed = std::ranges::count(text_, ')');
    if (opened != closed)
      fail("it has " + std::to_string(opened) + " '(' and " + std::to_string(closed) + " ')'",
           opened > closed ? "add a ')'" : "remove a ')'");
  }
  /// Says that the token that comes next stands where it does not belong.
  [[noreturn]] void fail_at(const std::string& token, const std::string& what, const std::string& advice = "") const {
    refuse_unbalanced();
    const std::string before = trimmed(text_.substr(0, at_));
    fail(quoted(token) + " stands " + (before.empty() ? "at the beginning" : "behind " + quoted(before)) + what,
         advice);
  }
  void skip_blanks() {
    while (at_ < text_.size() && std::isspace(static_cast<unsigned char>(text_[at_])) != 0) ++at_;
  }
  bool comes(const std::string& token) {
    skip_blanks();
    return text_.compare(at_, token.size(), token) == 0;
  }
  bool accept(const std::string& token) {
    if (!comes(token)) return false;
    at_ += token.size();
    return true;
  }
  /// What comes next, for messages: a name, a number, or one character; "" at the end.
  std::string next_token() {
    skip_blanks();
    std::size_t end = at_;
    const auto is_name = [&] { return end < text_.size() && (is_name_byte(text_[end]) || text_[end] == '.'); };
    const auto continues_character = [&] { return end < text_.size() && (text_[end] & 0xc0) == 0x80; };  // in UTF-8
    if (!is_name() && end < text_.size()) ++end;
    while (continues_character()) ++end;
    if (end == at_ || end > at_ + 1)  // a name, or a unit such as '°C'
      while (is_name()) ++end;
    return text_.substr(at_, end - at_);
  }

  const Infix* infix() {
    for (const Infix& each : infixes)
      if (comes(each.text)) return &each;
    if (comes("=")) fail("'=' assigns", "compare with '=='");
    return nullptr;
  }

  void append(Operation operation) { parsed_.program.append({.operation = operation}); }
  void push(double value) { parsed_.program.append({.operation = Operation::linear, .offset = value}); }

  /// An expression whose operators have at least this priority.
  void expression(int least) {
    if (++nesting_ > deepest_nesting) fail("it is nested deeper than " + std::to_string(deepest_nesting) + " times");
    operand();
    while (const Infix* next = infix()) {
      if (next->priority < least) break;
      at_ += std::string(next->text).size();
      // x^y^z is x^(y^z); all others go from left to right.
      expression(next->priority == Priority::power ? next->priority : next->priority + 1);
      append(next->operation);
    }
    if (least <= Priority::choice && accept("?")) {
      expression(Priority::choice);
      if (!accept(":")) fail("its '?' and ':' do not belong together", "write 'condition ? value : other value'");
      expression(Priority::choice);
      append(Operation::select);
    }
    --nesting_;
  }

  void operand() {
    if (accept("+")) return expression(Priority::sign);
    if (accept("-")) {
      expression(Priority::sign);
      return append(Operation::negate);
    }
    if (accept("(")) {
      expression(Priority::choice);
      return close();
    }
    skip_blanks();
    const bool is_number =
        at_ < text_.size() && (std::isdigit(static_cast<unsigned char>(text_[at_])) != 0 || text_[at_] == '.');
    if (is_number) return number();
    if (at_ < text_.size() && begins_name(text_[at_])) return name();
    const std::string token = next_token();
    if (token == "=") fail("'=' assigns", "compare with '=='");
    refuse_unbalanced();
    if (token.empty()) fail("it ends where a value belongs");
    const bool is_known = std::string("+-*/^<>=!&|?:,)").find(token[0]) != std::string::npos;
    if (is_known) fail_at(token, ", where a value or an operator belongs");
    fail_at(trimmed(text_.substr(at_)), ", which means nothing");
  }

  void close() {
    if (accept(")")) return;
    const std::string token = next_token();
    if (token == ",") fail("a ',' stands where no function takes several values", "write decimals with a point");
    refuse_unbalanced();
    if (token == "?" || token == ":")
      fail("its '?' and ':' do not belong together", "write 'condition ? value : other value'");
    fail_at(token, " without an operator between them", "write '*' for a product");
  }

  void number() {
    const Leading read = leading_number(text_.data() + at_, text_.data() + text_.size());
    if (read.length == 0) fail_at(next_token(), ", which is no number");
    at_ += read.length;
    push(read.value);
  }

  void name() {
    const std::size_t begin = at_;
    while (at_ < text_.size() && is_name_byte(text_[at_])) ++at_;
    const std::string name = text_.substr(begin, at_ - begin);
    if (comes("(")) return call(name);
    const auto variable = std::ranges::find(names_.variables, name);
    if (variable != names_.variables.end()) {
      const auto index = static_cast<int>(variable - names_.variables.begin());
      return parsed_.program.append({.operation = Operation::linear, .variable = index, .factor = 1});
    }
    if (name == "pi") return push(std::numbers::pi);
    if (name == "e") return push(std::numbers::e);
    for (const auto& [unit, value] : names_.units) {
      if (unit != name) continue;
      parsed_.mentions_unit = true;
      return push(value);
    }
    if (function_of_one(name) || function_of_several(name))
      fail(quoted(name) + " is a function, and no parenthesis follows it", "write '" + name + "(…)'");
    throw Problem{"", "", "", name, known_names()};
  }

  void call(const std::string& name) {
    const NamedFunction* one = function_of_one(name);
    const Several* several = function_of_several(name);
    if (!one && !several) {
      if (std::ranges::count(names_.variables, name) > 0)
        fail_at("(", " without an operator between them", "write '*' for a product");
      throw Problem{"", "", "", name, known_names()};
    }
    accept("(");
    const std::size_t begin = at_;
    int count = 0;
    if (!comes(")")) do {
        expression(Priority::choice);
        // Functions of many values are made of functions of two.
        if (++count > 1 && several && several->most > 3) append(several->operation);
      } while (accept(","));
    refuse_degrees(name, trimmed(text_.substr(begin, at_ - begin)));
    close();
    const int least = one ? 1 : several->least, most = one ? 1 : several->most;
    if (count < least || count > most)
      fail(quoted(name) + " takes " + (count < least ? "more" : "fewer") + " values than it has",
           name == "if" ? "write 'if(condition, value, other value)'" : "");
    if (one) parsed_.program.append({.operation = Operation::apply, .function = one});
    if (several && several->most <= 3) append(several->operation);
  }

  /// Refuses the sine of a plain number that is more than a full turn: degrees, as a rule.
  void refuse_degrees(const std::string& function, const std::string& argument) const {
    if (function != "sin" && function != "cos" && function != "tan") return;
    const Leading number = leading_number(argument.data(), argument.data() + argument.size());
    if (number.length != argument.size() || !(std::abs(number.value) > 2 * std::numbers::pi)) return;
    throw Problem{" has '" + function + "(" + argument + ")'",
                  "a plain number is an angle in radians, and this one is more than a full turn",
                  "write '" + function + "(" + argument + " deg)' for degrees"};
  }

  /// The names that messages suggest.
  std::vector<std::string> known_names() const {
    std::vector<std::string> names = names_.variables;
    for (const char* constant : {"pi", "e"}) names.emplace_back(constant);
    const auto first = static_cast<std::ptrdiff_t>(names.size());
    for (const NamedFunction& function : functions_of_one()) names.emplace_back(function.name);
    for (const Several& function : functions_of_several) names.emplace_back(function.name);
    std::sort(names.begin() + first, names.end());
    names.insert(names.end(), names_.suggested_units.begin(), names_.suggested_units.end());
    return names;
  }

  const std::string& text_;
  const Names& names_;
  std::size_t at_ = 0;
  int nesting_ = 0;
  Parsed parsed_;
};

}  // namespace

Parsed parse(const std::string& text, const Names& names) { return Parser(text, names).parse(); }

}  // namespace sprekk::formula
