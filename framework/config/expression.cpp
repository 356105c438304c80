#include "framework/config/expression.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cctype>
#include <cmath>
#include <memory>
#include <optional>

#include "framework/config/unknown_key.hpp"
#include "framework/formula/jumps.hpp"
#include "framework/formula/parser.hpp"
#include "framework/round_off.hpp"

namespace sprekk {
namespace {

constexpr std::size_t time_index = dimension, first_of_state = dimension + 1;
using Variables = std::array<double, first_of_state + formula::most_derivatives>;

using UnitSizes = std::array<double, 5>;
constexpr UnitSizes usual_sizes = {1, 1, 1, 1, 1};

/// The factor of a quantity of this dimension in units of m, kg, s, K and rad that are smaller by the factors `sizes`.
double in_sizes(const Dimension& dimension, const UnitSizes& sizes) {
  double factor = 1;
  for (std::size_t i = 0; i < sizes.size(); ++i) factor *= std::pow(sizes[i], dimension.exponents[i]);
  return factor;
}

formula::Names names_of(const StateVariables& state, const UnitSizes& sizes) {
  formula::Names names{{axis_names.begin(), axis_names.end()},
                       unit_constants(),
                       {"m",   "mm",  "cm",  "km",  "kg", "s", "h", "day", "year", "Pa",
                        "kPa", "MPa", "GPa", "bar", "N",  "J", "K", "deg", "rad",  "l"}};
  names.variables.emplace_back("t");
  for (const StateVariable& variable : state) names.variables.push_back(variable.name);
  if (sizes != usual_sizes)
    for (auto& [name, value] : names.units) value *= in_sizes(parse_unit(name).dimension, sizes);
  return names;
}

formula::Parsed parse(const std::string& text, const StateVariables& state, const Origin& where,
                      const UnitSizes& sizes = usual_sizes) {
  try {
    return formula::parse(text, names_of(state, sizes));
  } catch (const formula::Problem& problem) {
    if (const std::string takers = formula_takers(problem.unknown); !takers.empty())
      throw InputError(where, "unknown name in the expression " + quoted(text) + ": " + quoted(problem.unknown), takers,
                       "take one of these, or a formula of place and time");
    if (!problem.unknown.empty())
      throw unknown_name(where, "name in the expression " + quoted(text) + ":", problem.unknown, problem.known);
    throw InputError(where, problem.has.empty() ? "malformed expression " + quoted(text) : quoted(text) + problem.has,
                     problem.why, problem.suggestion);
  }
}

Variables variables_at(const Place& place, std::span<const double> state = {}) {
  Variables variables;
  for (int k = 0; k < dimension; ++k) variables[k] = place.x[k];
  variables[time_index] = place.t;
  std::ranges::copy(state, variables.begin() + first_of_state);
  return variables;
}

/// The variables of the state that it names, a bit for each.
std::uint32_t state_named(const formula::Program& program, std::size_t variables) {
  std::uint32_t named = 0;
  for (std::size_t k = 0; k < variables; ++k)
    if (program.uses(static_cast<int>(first_of_state + k))) named |= 1U << k;
  return named;
}

/// A step whose solution lies where a formula jumps has none.
void refuse_jump(const formula::Program& program, const StateVariables& state, const std::string& text,
                 const std::string& name, const Origin& where) {
  const std::optional<formula::Jump> jump = formula::find_jump(program, first_of_state, first_of_state + state.size());
  if (!jump) return;
  const StateVariable& variable = state[jump->variable - first_of_state];
  throw InputError(
      where,
      fmt::format("{} jumps from {:.6g} to {:.6g} at {} = {:.6g}{}{}: {}", quoted(name), jump->from, jump->to,
                  variable.name, jump->at, variable.unit.empty() ? "" : " ", variable.unit, quoted(text)),
      "no state between the two fulfils the equations, so that steps would fail there",
      "lead from one value to the other over a short way, for example by 'min' and 'max'");
}

/// Why a value is none.
std::string why_not_finite(double value) {
  return std::isnan(value) ? "it is no number: 0/0, or a root, a logarithm or a power that does not exist"
                           : "it is infinite: a division by zero, or a number beyond 1e308";
}

/// An expression with what its messages say.
struct Expression {
  std::string text;
  double scale;
  Origin where;
  formula::Program program;
  std::uint32_t named = 0;  ///< of the state, as state_named

  void require_finite(double value, const char* what, const Place& place) const {
    if (!std::isfinite(value))
      throw DataError(fmt::format("{}: the expression {} has no finite {} at {} ({})", where.text(), quoted(text), what,
                                  place_text(place), why_not_finite(value)));
  }

  double at(const Place& place) const {
    const Variables variables = variables_at(place);
    const double value = scale * program.at(variables);
    require_finite(value, "value", place);
    return value;
  }

  double at_state(const Place& place) const {
    const StateNow* state = state_now();
    if (!state)
      throw DataError(fmt::format("{}: the expression {} is a formula of the state, and is needed where there is none",
                                  where.text(), quoted(text)));
    *state->named |= named;
    const Variables variables = variables_at(place, state->values);
    const formula::Dual dual =
        state->by.empty() ? formula::Dual{program.at(variables)} : program.at(variables, first_of_state);
    require_finite(scale * dual.value, "value", place);
    for (std::size_t k = 0; k < state->by.size(); ++k) {
      require_finite(dual.by[k], "derivative", place);
      state->by[k] += scale * dual.by[k];
    }
    return scale * dual.value;
  }
};

}  // namespace

std::string place_text(const Place& place) {
  std::string text;
  for (int k = 0; k < dimension; ++k) text += fmt::format("{} = {}, ", axis_names[k], place.x[k]);
  text += fmt::format("t = {}", place.t);
  const StateNow* state = state_now();
  for (std::size_t k = 0; state && k < state->values.size(); ++k) {
    if ((*state->named >> k & 1U) == 0) continue;
    const auto& [name, unit, doc] = state->variables[k];
    text += fmt::format(", {} = {:.6g}{}{}", name, state->values[k], unit.empty() ? "" : " ", unit);
  }
  return text;
}

Data parse_expression(const std::string& text, double scale, const Origin& where, const std::string& name,
                      const StateVariables& state) {
  const auto expression = std::make_shared<Expression>(text, scale, where, parse(text, state, where).program);
  const formula::Program& program = expression->program;
  expression->named = state_named(program, state.size());
  bool uses_space = false;
  for (int k = 0; k < dimension; ++k) uses_space = uses_space || program.uses(k);
  const bool uses_time = program.uses(time_index);
  if (expression->named != 0) {
    refuse_jump(program, state, text, name, where);
    return Data([expression](const Place& place) { return expression->at_state(place); }, uses_time, true);
  }
  if (uses_time || uses_space)
    return Data([expression](const Place& place) { return expression->at(place); }, uses_time, uses_space);
  const double value = scale * program.at({});
  if (!std::isfinite(value)) throw InputError(where, quoted(text) + " has no finite value", why_not_finite(value));
  return value;
}

namespace {

/// Places and times at which dimensions are tested: none that a condition in an expression is likely to name.
constexpr std::array times = {0.7318, 917.3, 5.2397e4, 8.7131e5, 1.1873e8};  // s, from seconds to years
std::vector<Place> test_places() {
  constexpr std::array lengths = {0.3719, -17.193, 1193.7};  // m, on both sides of 0
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
  formula::Program before, after;
  UnitSizes sizes;
  const StateVariables& state;

  Resized(formula::Program as_usual, formula::Program as_resized, const UnitSizes& unit_sizes,
          const StateVariables& variables)
      : before(std::move(as_usual)), after(std::move(as_resized)), sizes(unit_sizes), state(variables) {}

  /// Whether its values change as those of a quantity with this dimension, with places and times as plain numbers or
  /// with units.
  bool has_dimension(const Dimension& dimension, bool has_length, bool has_time) const {
    for (const auto& [first, value] : values(has_length, has_time)) {
      const double expected = in_sizes(dimension, sizes) * first;
      if (!std::isfinite(expected) || !std::isfinite(value)) continue;
      if (std::abs(value - expected) > rounding::same * std::max(std::abs(value), std::abs(expected))) return false;
    }
    return true;
  }

  /// By which factor its values change; 1 where none is known.
  double factor(bool has_length, bool has_time) const {
    for (const auto& [first, value] : values(has_length, has_time))
      if (const double change = value / first; std::isfinite(change) && change > 0) return change;
    return 1;
  }

 private:
  /// Values before and after, at a few places and states.
  std::vector<std::pair<double, double>> values(bool has_length, bool has_time) const {
    int decade = 9;  // of the state: from large values to small ones, in SI units
    std::vector<std::pair<double, double>> all;
    for (const Place& place : test_places()) {
      std::vector<double> of_state, resized_state;
      for (const StateVariable& variable : state) {
        of_state.push_back(times.front() * std::pow(10, decade));
        resized_state.push_back(of_state.back() * in_sizes(parse_unit(variable.unit).dimension, sizes));
      }
      --decade;
      Place resized = place;
      if (has_length) resized.x *= sizes[0];
      if (has_time) resized.t *= sizes[2];
      all.emplace_back(before.at(variables_at(place, of_state)), after.at(variables_at(resized, resized_state)));
    }
    return all;
  }
};

}  // namespace

LackOfUnit lack_of_unit(const std::string& text, const Dimension& dimension, const Origin& where,
                        const StateVariables& state) {
  const bool is_length = dimension == parse_unit("m").dimension;
  // Sizes of units of which no two products of powers are equal; near 1, so that conditions in the expression keep
  // their outcomes. An angle is a number (its size is 1) unless `dimension` contains one, and so is a length if
  // `dimension` is a length and the expression names no state.
  UnitSizes sizes;
  const double squares[] = {2, 3, 5, 7, 11};
  for (std::size_t i = 0; i < sizes.size(); ++i) sizes[i] = std::exp(1e-2 * std::sqrt(squares[i]));
  if (dimension.exponents[4] == 0) sizes[4] = 1;
  const formula::Parsed parsed = parse(text, state, where);
  const bool of_state = state_named(parsed.program, state.size()) != 0;
  if (is_length && !of_state) sizes[0] = 1;
  const bool has_units = parsed.mentions_unit || of_state;
  if (!has_units && (is_length || dimension == Dimension{})) return LackOfUnit::none;
  const Resized expression{parsed.program, parse(text, state, where, sizes).program, sizes, state};
  for (const bool has_length : {false, true})
    for (const bool has_time : {false, true})
      if (expression.has_dimension(dimension, has_length, has_time)) return LackOfUnit::none;
  return has_units ? LackOfUnit::of_a_term : LackOfUnit::any;
}

std::optional<Dimension> dimension_of(const std::string& text, const Origin& where, const StateVariables& state) {
  constexpr double size = 1.01;    // near 1, so that conditions in the expression keep their outcomes
  constexpr double fraction = 12;  // exponents are multiples of 1/12: roots of squares, cubes and their products
  const formula::Program usual = parse(text, state, where).program;
  for (const bool has_length : {true, false})
    for (const bool has_time : {true, false}) {
      Dimension dimension;
      for (std::size_t i = 0; i < dimension.exponents.size(); ++i) {
        UnitSizes sizes = usual_sizes;
        sizes[i] = size;
        const Resized resized(usual, parse(text, state, where, sizes).program, sizes, state);
        const double exponent = std::log(resized.factor(has_length, has_time)) / std::log(size);
        dimension.exponents[i] = std::round(fraction * exponent) / fraction;
      }
      if (lack_of_unit(text, dimension, where, state) == LackOfUnit::none) return dimension;
    }
  return std::nullopt;
}

bool names(const std::string& text, const std::string& name) {
  const auto is_of_name = [&](std::size_t at) {
    return at < text.size() && (std::isalnum(static_cast<unsigned char>(text[at])) != 0 || text[at] == '_');
  };
  for (std::size_t at = text.find(name); at != std::string::npos; at = text.find(name, at + 1))
    if ((at == 0 || !is_of_name(at - 1)) && !is_of_name(at + name.size())) return true;
  return false;
}

bool is_free_name(const std::string& name, const StateVariables& state) {
  try {
    formula::parse(name, names_of(state, usual_sizes));
  } catch (const formula::Problem& problem) {
    return problem.unknown == name;
  }
  return false;
}

}  // namespace sprekk
