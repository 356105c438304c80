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
#include <regex>

#include "framework/config/number.hpp"
#include "framework/config/unit.hpp"

namespace sprekk {
namespace {

constexpr std::size_t longest_expression = 4000;  // characters: no formula is longer

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

/// The names that messages suggest.
std::vector<std::string> known_names(const mu::Parser& parser) {
  std::vector<std::string> names = {"t", "pi", "e"};
  names.insert(names.begin(), axis_names.begin(), axis_names.end());
  for (const auto& [name, unused] : parser.GetFunDef()) names.push_back(name);
  for (const char* unit : {"m",   "mm",  "cm",  "km",  "kg", "s", "h", "day", "year", "Pa",
                           "kPa", "MPa", "GPa", "bar", "N",  "J", "K", "deg", "rad",  "l"})
    names.push_back(unit);
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

/// The factor of a quantity of this dimension in units of m, kg, s, K and rad that are smaller by the factors `sizes`.
double in_sizes(const Dimension& dimension, const std::array<double, 5>& sizes) {
  double factor = 1;
  for (std::size_t i = 0; i < sizes.size(); ++i) factor *= std::pow(sizes[i], dimension.exponents[i]);
  return factor;
}

/// A formula and its parser. The parser holds the addresses of the variables, so the object must not move, and one
/// thread at a time may use it.
class Expression {
 public:
  Expression(const std::string& text, double scale, const Origin& where) : text_(text), scale_(scale), where_(where) {
    define_functions(parser_);
    define_constants(parser_);
    for (int k = 0; k < dimension; ++k) parser_.DefineVar(axis_names[k], &x_[k]);
    parser_.DefineVar("t", &t_);
    if (text.size() > longest_expression) fail("it is longer than 4000 characters");
    if (has_assignment(text)) fail("'=' assigns", "compare with '=='");
    refuse_degrees();
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
  /// Gives m, kg, s, K and rad other sizes: those of before over `sizes`.
  void resize_units(const std::array<double, 5>& sizes) {
    for (const auto& [name, value] : unit_constants())
      parser_.DefineConst(name, value * in_sizes(parse_unit(name).dimension, sizes));
  }

  double unchecked(const Place& place) {
    const std::lock_guard lock(one_at_a_time_);
    x_ = place.x;
    t_ = place.t;
    return scale_ * parser_.Eval();
  }

  double at(const Place& place) {
    const double value = unchecked(place);
    if (std::isfinite(value)) return value;
    throw DataError(fmt::format("{}: the expression {} has no finite value at {} ({})", where_.text(), quoted(text_),
                                place_text(place), why_not_finite(value)));
  }

  /// Why a value is none.
  static std::string why_not_finite(double value) {
    return std::isnan(value) ? "it is no number: 0/0, or a root, a logarithm or a power that does not exist"
                             : "it is infinite: a division by zero, or a number beyond 1e308";
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

  /// Refuses the sine of a plain number that is more than a full turn: degrees, as a rule.
  void refuse_degrees() const {
    static const std::regex pattern(R"(\b(sin|cos|tan)\s*\(\s*(-?[0-9]+\.?[0-9]*)\s*\))");
    constexpr std::size_t longest_of_regex = 500;  // characters: std::regex needs a part of the stack for each
    if (text_.size() > longest_of_regex) return;
    for (std::sregex_iterator match(text_.begin(), text_.end(), pattern), end; match != end; ++match)
      if (std::abs(std::stod(match->str(2))) > 2 * std::numbers::pi)
        throw InputError(where_, fmt::format("{} has '{}'", quoted(text_), match->str()),
                         "a plain number is an angle in radians, and this one is more than a full turn",
                         fmt::format("write '{}({} deg)' for degrees", match->str(1), match->str(2)));
  }

  [[noreturn]] void refuse(const mu::ParserError& error) const {
    if (error.GetCode() == mu::ecUNASSIGNABLE_TOKEN) {
      std::string name = error.GetToken();
      name.erase(
          std::find_if_not(name.begin(), name.end(), [](unsigned char c) { return std::isalnum(c) || c == '_'; }),
          name.end());
      if (parser_.GetFunDef().count(name) > 0)
        fail(fmt::format("'{}' is a function, and no parenthesis follows it", name), "write '" + name + "(…)'");
      if (!name.empty())
        throw unknown_name(where_, "name in the expression " + quoted(text_) + ":", name, known_names(parser_));
    }
    const auto opened = std::ranges::count(text_, '('), closed = std::ranges::count(text_, ')');
    if (opened != closed)
      fail(fmt::format("it has {} '(' and {} ')'", opened, closed), opened > closed ? "add a ')'" : "remove a ')'");
    const std::string token = quoted(trimmed(error.GetToken()));
    const auto at = static_cast<std::size_t>(std::max<long>(0, static_cast<long>(error.GetPos())));
    const std::string before = trimmed(text_.substr(0, std::min(at, text_.size())));
    const std::string behind = before.empty() ? "at the beginning" : "behind " + quoted(before);
    switch (error.GetCode()) {
      case mu::ecUNEXPECTED_OPERATOR:
      case mu::ecUNEXPECTED_PARENS:
        fail(fmt::format("{} stands {}, where a value or an operator belongs", token, behind));
      case mu::ecUNEXPECTED_VAL:
      case mu::ecUNEXPECTED_VAR:
      case mu::ecUNEXPECTED_FUN:
        fail(fmt::format("{} stands {} without an operator between them", token, behind), "write '*' for a product");
      case mu::ecUNEXPECTED_EOF:
        fail("it ends where a value belongs");
      case mu::ecUNEXPECTED_ARG_SEP:
      case mu::ecUNEXPECTED_ARG:
        fail(fmt::format("a ',' stands {}, where no function takes several values", behind),
             "write decimals with a point");
      case mu::ecUNASSIGNABLE_TOKEN:
        fail(fmt::format("{} stands {}, which means nothing", token, behind));
      case mu::ecMISSING_ELSE_CLAUSE:
      case mu::ecMISPLACED_COLON:
        fail("its '?' and ':' do not belong together", "write 'condition ? value : other value'");
      case mu::ecTOO_MANY_PARAMS:
      case mu::ecTOO_FEW_PARAMS:
        fail(fmt::format("{} takes {} values than it has", token,
                         error.GetCode() == mu::ecTOO_MANY_PARAMS ? "fewer" : "more"),
             trimmed(error.GetToken()) == "if" ? "write 'if(condition, value, other value)'" : "");
      default:
        fail(error.GetMsg());
    }
  }

  std::string text_;
  double scale_;
  Origin where_;
  Point x_ = Point::Zero();
  double t_ = 0;
  bool uses_time_ = false, uses_space_ = false;
  mu::Parser parser_;
  std::mutex one_at_a_time_;
};

}  // namespace

std::string place_text(const Place& place) {
  std::string text;
  for (int k = 0; k < dimension; ++k) text += fmt::format("{} = {}, ", axis_names[k], place.x[k]);
  return text + fmt::format("t = {}", place.t);
}

Data parse_expression(const std::string& text, double scale, const Origin& where) {
  const auto expression = std::make_shared<Expression>(text, scale, where);
  if (expression->uses_time() || expression->uses_space()) {
    return Data([expression](const Place& place) { return expression->at(place); }, expression->uses_time(),
                expression->uses_space());
  }
  const double value = expression->unchecked({});
  if (!std::isfinite(value))
    throw InputError(where, quoted(text) + " has no finite value", Expression::why_not_finite(value));
  return value;
}

namespace {

/// Places and times at which dimensions are tested: none that a condition in an expression is likely to name.
std::vector<Place> test_places() {
  constexpr std::array times = {0.7318, 917.3, 5.2397e4, 8.7131e5, 1.1873e8};  // s, from seconds to years
  constexpr std::array lengths = {0.3719, -17.193, 1193.7};                    // m, on both sides of 0
  std::vector<Place> places;
  for (const double t : times)
    for (const double x : lengths) {
      Point at = Point::Constant(x);
      for (int k = 1; k < dimension; ++k) at[k] = k * lengths[places.size() % 2] - x;
      places.push_back({at, 0, t});
    }
  return places;
}

/// An expression before and after its units have got other sizes.
struct Resized {
  Expression before, after;
  std::array<double, 5> sizes;

  /// Whether its values change as those of a quantity with this dimension, with places and times as plain numbers or
  /// with units.
  bool has_dimension(const Dimension& dimension, bool has_length, bool has_time) {
    constexpr double rounding = 1e-9;  // powers of units after a few operations
    for (const Place& place : test_places()) {
      Place resized = place;
      if (has_length) resized.x *= sizes[0];
      if (has_time) resized.t *= sizes[2];
      const double expected = in_sizes(dimension, sizes) * before.unchecked(place), value = after.unchecked(resized);
      if (!std::isfinite(expected) || !std::isfinite(value)) continue;
      if (std::abs(value - expected) > rounding * std::max(std::abs(value), std::abs(expected))) return false;
    }
    return true;
  }
};

}  // namespace

LackOfUnit lack_of_unit(const std::string& text, const Dimension& dimension, const Origin& where) {
  const bool is_length = dimension == parse_unit("m").dimension;
  // Sizes of which no two products of powers are equal, near 1 so that conditions in the expression still hold. Angles
  // count as numbers unless the dimension has one, and so do lengths where it is a length.
  std::array<double, 5> sizes;
  const double squares[] = {2, 3, 5, 7, 11};
  for (std::size_t i = 0; i < sizes.size(); ++i) sizes[i] = std::exp(1e-2 * std::sqrt(squares[i]));
  if (dimension.exponents[4] == 0) sizes[4] = 1;
  if (is_length) sizes[0] = 1;
  Resized expression{{text, 1, where}, {text, 1, where}, sizes};
  const bool has_units = expression.before.mentions_unit();
  if (!has_units && (is_length || dimension == Dimension{})) return LackOfUnit::none;
  expression.after.resize_units(sizes);
  for (const bool has_length : {false, true})
    for (const bool has_time : {false, true})
      if (expression.has_dimension(dimension, has_length, has_time)) return LackOfUnit::none;
  return has_units ? LackOfUnit::of_a_term : LackOfUnit::any;
}

}  // namespace sprekk
