// Properties of a fluid as formulas of its temperature and its pressure.
#pragma once

#include <array>
#include <cmath>
#include <string>

#include "framework/config/input_error.hpp"
#include "framework/config/state.hpp"

namespace sprekk::couplers {

/// The variables that formulas of a fluid may name.
inline const StateVariables& fluid_variables() {
  static const StateVariables variables = {{"T", "K", "temperature"}, {"p", "Pa", "pressure"}};
  return variables;
}

/// A property, with its derivatives by temperature and pressure.
struct OfFluid {
  double value;
  std::array<double, 2> by{};
};

/// The value of a property at a temperature (K) and a pressure (Pa). Throws DataError as Data::at does.
inline OfFluid of_fluid(const Data& formula, double temperature, double pressure, const Place& place = {}) {
  OfFluid result{};
  result.value = value_at_state(formula, place, fluid_variables(), std::array{temperature, pressure}, result.by);
  return result;
}

/// Throws InputError where a property depends on a place or the time.
inline void refuse_place(const Data& formula, const Origin& where, const std::string& name) {
  constexpr double temperature = 300, pressure = 1e5;  // K, Pa: usual ones
  Place elsewhere;
  elsewhere.x.setConstant(NAN);
  const auto has_value = [&](const Place& place) {
    try {
      return std::isfinite(of_fluid(formula, temperature, pressure, place).value);
    } catch (const DataError&) {
      return false;
    }
  };
  if (formula.depends_on_time() || (has_value({}) && !has_value(elsewhere)))
    throw InputError(where, quoted(name) + " depends on place or time", "a fluid is the same everywhere and always",
                     "write a formula of T and p");
}

}  // namespace sprekk::couplers
