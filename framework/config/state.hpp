// The state as formulas see it, and which parameters may be formulas of it.
#pragma once

#include <cstdint>
#include <functional>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "framework/config/data.hpp"

namespace sprekk {

/// A quantity of the state that formulas may name.
struct StateVariable {
  std::string name, unit;  ///< unit: SI, "" for a plain number
  std::string doc;         ///< a few words
};
/// The variables of the formulas of one parameter, at most formula::most_derivatives.
using StateVariables = std::vector<StateVariable>;

/// A formula has no value in a state, or one outside of its range. While an equation is solved, another state may have
/// one.
class StateError : public DataError {
 public:
  using DataError::DataError;
};

/// The value of a datum where the state has these values, one for each variable. A datum that is a formula sets `by` to
/// its derivatives by them, all others to zero; an empty `by` is left alone. Throws as Data::at does, StateError where
/// the value depends on the state.
double value_at_state(const Data& data, const Place& place, const StateVariables& variables,
                      std::span<const double> values, std::span<double> by = {});

/// The variables that a datum names at this place, a bit for each; 0 where it is no formula of them.
std::uint32_t variables_named(const Data& data, const Place& place, const StateVariables& variables);

/// Declares that a datum may be a formula of these variables, which must outlive it: the parameter of a spec, by the
/// names of both. Whoever reads it takes its values by value_at_state.
void may_be_formula(const std::string& spec, const std::string& parameter, const StateVariables& variables);
/// What formulas of the parameter may name; nullptr if it may be none.
const StateVariables* formula_variables(const std::string& spec, const std::string& parameter);
/// "A formula may name NAME (what it is, unit), …", or "" for a parameter that may be none.
std::string formula_text(const std::string& spec, const std::string& parameter);

/// A guard: while it exists, expressions are read as formulas of these variables; with nullptr, of place and time
/// alone.
class ReadsFormula {
 public:
  explicit ReadsFormula(const StateVariables* variables);
  ~ReadsFormula();
  ReadsFormula(const ReadsFormula&) = delete;
  ReadsFormula& operator=(const ReadsFormula&) = delete;
  /// The variables of the innermost guard; empty without one.
  static const StateVariables& variables();

 private:
  const StateVariables* before_;
};

/// The variables of two sets behind one another. The same ones are the same object, which lives as long as the program.
const StateVariables& joined(const StateVariables& first, const StateVariables& second);

/// A guard around the reading of a map of parameters: what let_formulas_name has added meanwhile ends with it.
class ReadsMap {
 public:
  ReadsMap();
  ~ReadsMap();
  ReadsMap(const ReadsMap&) = delete;
  ReadsMap& operator=(const ReadsMap&) = delete;

 private:
  std::function<StateVariables()> before_;
};
/// Lets the formulas of all further parameters of the map that is being read name what the map itself declares.
/// `further` is asked when a formula is read, and may throw InputError.
void let_formulas_name(std::function<StateVariables()> further);
/// The variables of a parameter, with those that formulas may name now beside them; nullptr for nullptr.
const StateVariables* with_declared(const StateVariables* variables);

/// The state that formulas read during a call of value_at_state, in this thread.
struct StateNow {
  const StateVariables& variables;
  std::span<const double> values;
  std::span<double> by;
  std::uint32_t* named;  ///< takes a bit for each variable that is named
};
/// The state that a formula has to take now; nullptr outside of value_at_state.
const StateNow* state_now();

/// A guard: while it exists, formulas add no derivatives.
class WithoutDerivatives {
 public:
  WithoutDerivatives();
  ~WithoutDerivatives();
  WithoutDerivatives(const WithoutDerivatives&) = delete;
  WithoutDerivatives& operator=(const WithoutDerivatives&) = delete;

 private:
  const StateNow* before_;
  std::optional<StateNow> without_;
};

}  // namespace sprekk
