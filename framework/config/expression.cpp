#include "framework/config/expression.hpp"

#include <fmt/format.h>
#include <muParser.h>

#include <algorithm>
#include <array>
#include <cctype>
#include <cmath>
#include <memory>
#include <mutex>
#include <numbers>

#include "framework/config/unit.hpp"

namespace sprekk {
namespace {

constexpr std::size_t longest_expression = 4000;

double minimum(const double* values, int count) { return *std::min_element(values, values + count); }
double maximum(const double* values, int count) { return *std::max_element(values, values + count); }
double select(double condition, double then, double otherwise) { return condition != 0 ? then : otherwise; }
double sign(double value) { return value > 0 ? 1 : value < 0 ? -1 : 0; }

using Function1 = double (*)(double);
using Function2 = double (*)(double, double);

void define_functions(mu::Parser& parser) {
  parser.ClearFun();
  const std::pair<const char*, Function1> of_one[] = {
      {"sin", std::sin},     {"cos", std::cos},     {"tan", std::tan},   {"asin", std::asin}, {"acos", std::acos},
      {"atan", std::atan},   {"sinh", std::sinh},   {"cosh", std::cosh}, {"tanh", std::tanh}, {"asinh", std::asinh},
      {"acosh", std::acosh}, {"atanh", std::atanh}, {"exp", std::exp},   {"log", std::log},   {"log10", std::log10},
      {"sqrt", std::sqrt},   {"abs", std::fabs},    {"erf", std::erf},   {"erfc", std::erfc}, {"sign", sign},
      {"floor", std::floor}, {"ceil", std::ceil}};
  for (const auto& [name, function] : of_one) parser.DefineFun(name, function);
  parser.DefineFun("atan2", static_cast<Function2>(std::atan2));
  parser.DefineFun("pow", static_cast<Function2>(std::pow));
  parser.DefineFun("if", select);
  parser.DefineFun("min", minimum);
  parser.DefineFun("max", maximum);
}

void define_constants(mu::Parser& parser) {
  parser.ClearConst();
  parser.DefineConst("pi", std::numbers::pi);
  parser.DefineConst("e", std::numbers::e);
  for (const auto& [name, value] : unit_constants()) parser.DefineConst(name, value);
}

std::vector<std::string> known_names(const mu::Parser& parser) {
  std::vector<std::string> names = {"x", "y", "t"};
  for (const auto& [name, unused] : parser.GetFunDef()) names.push_back(name);
  for (const auto& [name, unused] : parser.GetConst()) {
    if (std::find(names.begin(), names.end(), name) == names.end()) names.push_back(name);
  }
  return names;
}

/// Whether the text assigns: muParser would let "x = 3" change the variable.
bool has_assignment(const std::string& text) {
  for (std::size_t i = 0; i < text.size(); ++i) {
    if (text[i] != '=') continue;
    const bool before = i > 0 && std::string("<>=!").find(text[i - 1]) != std::string::npos;
    const bool after = i + 1 < text.size() && text[i + 1] == '=';
    if (!before && !after) return true;
  }
  return false;
}

/// A formula and its parser. The parser holds the addresses of the variables, so the object must not move, and one
/// thread at a time may use it.
class Expression {
 public:
  Expression(const std::string& text, double scale, const Origin& where) : text_(text), scale_(scale), where_(where) {
    define_functions(parser_);
    define_constants(parser_);
    parser_.DefineVar("x", &x_);
    parser_.DefineVar("y", &y_);
    parser_.DefineVar("t", &t_);
    if (text.size() > longest_expression) fail("it is longer than 4000 characters");
    if (has_assignment(text)) fail("'=' assigns", "compare with '=='");
    try {
      parser_.SetExpr(text);
      parser_.Eval();
      if (parser_.GetNumResults() != 1)
        fail("it has several values, separated by commas", "write decimals with a point");
      for (const auto& [name, unused] : parser_.GetUsedVar()) (name == "t" ? uses_time_ : uses_space_) = true;
    } catch (const mu::ParserError& error) {
      refuse(error);
    }
  }
  Expression(const Expression&) = delete;
  Expression& operator=(const Expression&) = delete;

  bool uses_time() const { return uses_time_; }
  bool uses_space() const { return uses_space_; }

  bool mentions_unit() const {
    return std::any_of(unit_constants().begin(), unit_constants().end(),
                       [this](const auto& unit) { return mentions(unit.first); });
  }
  /// The value in units of m, kg, s, K and rad that are smaller by the factors `sizes`.
  double in_units(const std::array<double, 5>& sizes) {
    for (const auto& [name, value] : unit_constants()) {
      const Dimension dimension = parse_unit(name).dimension;
      double factor = 1;
      for (std::size_t i = 0; i < sizes.size(); ++i) factor *= std::pow(sizes[i], dimension.exponents[i]);
      parser_.DefineConst(name, value * factor);
    }
    return parser_.Eval();
  }

  double unchecked(const Place& place) {
    const std::lock_guard lock(one_at_a_time_);
    x_ = place.x[0];
    y_ = place.x[1];
    t_ = place.t;
    return scale_ * parser_.Eval();
  }

  double at(const Place& place) {
    const double value = unchecked(place);
    if (std::isfinite(value)) return value;
    throw DataError(
        fmt::format("{}: the expression {} is {} at {}", where_.text(), quoted(text_), value, place_text(place)));
  }

 private:
  /// Whether the name occurs as a whole word, not as a function.
  bool mentions(const std::string& name) const {
    const auto in_word = [](char c) {
      return std::isalnum(static_cast<unsigned char>(c)) != 0 || c == '_' || c == '.';
    };
    for (std::size_t at = text_.find(name); at != std::string::npos; at = text_.find(name, at + 1)) {
      const std::size_t end = at + name.size();
      const std::size_t next = text_.find_first_not_of(' ', end);
      if ((at == 0 || !in_word(text_[at - 1])) && (end == text_.size() || !in_word(text_[end])) &&
          (next == std::string::npos || text_[next] != '('))
        return true;
    }
    return false;
  }

  [[noreturn]] void fail(const std::string& why, const std::string& suggestion = "") const {
    throw InputError(where_, "malformed expression " + quoted(text_), why, suggestion);
  }

  [[noreturn]] void refuse(const mu::ParserError& error) const {
    if (error.GetCode() == mu::ecUNASSIGNABLE_TOKEN) {
      std::string name = error.GetToken();
      name.erase(
          std::find_if_not(name.begin(), name.end(), [](unsigned char c) { return std::isalnum(c) || c == '_'; }),
          name.end());
      if (!name.empty())
        throw unknown_name(where_, "name in the expression " + quoted(text_) + ":", name, known_names(parser_));
    }
    fail(error.GetMsg());
  }

  std::string text_;
  double scale_;
  Origin where_;
  double x_ = 0, y_ = 0, t_ = 0;
  bool uses_time_ = false, uses_space_ = false;
  mu::Parser parser_;
  std::mutex one_at_a_time_;
};

}  // namespace

std::string place_text(const Place& place) {
  return fmt::format("x = {}, y = {}, t = {}", place.x[0], place.x[1], place.t);
}

Data parse_expression(const std::string& text, double scale, const Origin& where) {
  const auto expression = std::make_shared<Expression>(text, scale, where);
  if (expression->uses_time() || expression->uses_space()) {
    return Data([expression](const Place& place) { return expression->at(place); }, expression->uses_time(),
                expression->uses_space());
  }
  const double value = expression->unchecked({});
  if (!std::isfinite(value)) throw InputError(where, quoted(text) + " is not finite", fmt::format("it is {}", value));
  return value;
}

LackOfUnit lack_of_unit(const std::string& text, const Dimension& dimension, const Origin& where) {
  Expression expression(text, 1, where);
  const LackOfUnit lack = expression.mentions_unit() ? LackOfUnit::of_a_term : LackOfUnit::any;
  if (expression.uses_time() || expression.uses_space()) return LackOfUnit::none;
  const double value = expression.unchecked({});
  // Sizes such that no two products of small powers of them are equal. Angles count as numbers, unless the dimension
  // has an angle.
  std::array<double, 5> sizes = {1.0137, 1.0171, 1.0193, 1.0229, 1};
  if (dimension.exponents[4] != 0) sizes[4] = 1.0271;
  double factor = 1;
  for (std::size_t i = 0; i < sizes.size(); ++i) factor *= std::pow(sizes[i], dimension.exponents[i]);
  constexpr double rounding = 1e-9;
  const double changed = expression.in_units(sizes);
  const bool differs = std::abs(changed - factor * value) > rounding * std::max(std::abs(changed), std::abs(value));
  return differs ? lack : LackOfUnit::none;
}

}  // namespace sprekk
