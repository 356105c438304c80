// Formulas of the state on the entities of a mesh, and the fields behind their variables.
#pragma once

#include <algorithm>
#include <cmath>
#include <limits>
#include <string>
#include <utility>
#include <vector>

#include "framework/assembly/history/history.hpp"
#include "framework/assembly/linear_expression.hpp"
#include "framework/assembly/step_time.hpp"
#include "framework/config/input_error.hpp"
#include "framework/config/state.hpp"
#include "framework/field/field.hpp"

namespace sprekk {

/// A datum that may be a formula, at fixed places.
class StateFormula {
 public:
  /// `history`: what it may name besides the variables, and must outlive it; it then changes with what that follows.
  StateFormula(Data data, const StateVariables& variables, std::vector<Place> places, const History* history = nullptr)
      : data_(std::move(data)), variables_(&variables), places_(std::move(places)) {
    if (data_.is_constant()) return;
    const StateVariables& all = history ? joined(variables, history->variables()) : variables;
    for (Place place : places_) {
      named_ |= variables_named(data_, place, all);
      for (const double t : data_.switch_times())  // what holds before, and from there on
        for (const double time : {std::nextafter(t, -std::numeric_limits<double>::infinity()), t}) {
          place.t = time;
          named_ |= variables_named(data_, place, all);
        }
    }
    if (!history) return;
    history_ = {*history, variables, named_};
    named_ |= history_.followed();
  }
  bool is_formula() const { return named_ != 0; }  ///< at some place
  /// Whether it changes with a variable, by itself or by what it remembers.
  bool names(std::size_t variable) const { return (named_ >> variable & 1U) != 0; }
  std::uint32_t recalled() const { return history_.taken(); }  ///< a bit for each variable of the history
  /// Changes when values do that are remembered from before the step.
  std::uint64_t version_of_history() const { return history_.version(); }
  const StateVariables& variables() const { return *variables_; }
  /// From now on `at` gives the values of this step (value_in_step). Returns whether they may differ from those before.
  bool set_time(const StepTime& step) {
    const double t = time_in_step(data_, step);
    if (places_.empty() || places_.front().t == t) return false;
    for (Place& place : places_) place.t = t;
    return true;
  }
  /// As value_at_state; derivatives are those of the whole formula, with what it remembers.
  double at(int place, std::span<const double> values, std::span<double> by, Memory memory = Memory::kept) const {
    const Place& at = places_[static_cast<std::size_t>(place)];
    if (history_.is_needed()) return history_.at(data_, at, place, values, by, memory);
    return value_at_state(data_, at, *variables_, values, by);
  }

 private:
  Data data_;
  const StateVariables* variables_;
  std::vector<Place> places_;
  std::uint32_t named_ = 0;
  TakesHistory history_;
};

/// A variable on the entities of a field: one of its components, times a factor.
struct StateField {
  Field* field = nullptr;
  int component = 0;
  double factor = 1;

  double now(int entity) const { return factor * field->now()[field->spec().components * entity + component]; }
};

/// A part whose formulas name what other parts determine. While a scene is built, couplers offer it what they know; the
/// model asks at the end whether anything is missing.
class TakesState {
 public:
  virtual ~TakesState() = default;
  /// The variable of this name is the sum of all fields that are offered for it. They must outlive this object.
  virtual void offer_state(const std::string& variable, const StateField& source) = 0;
  /// Throws InputError where a formula names a variable that has not been offered.
  virtual void require_state() const = 0;
};

/// A variable on the entities of a mesh: an expression of fields, times a factor for each entity.
struct StateExpression {
  const LinearExpression* expression = nullptr;
  Vector factors = {};
};

/// A part whose formulas name what others know by expressions (beside TakesState, which asks whether any are missing).
class TakesExpressions {
 public:
  virtual ~TakesExpressions() = default;
  /// To be called while a scene is built. The expression must outlive this object, and has no rows until the first
  /// step.
  virtual void offer_expression(const std::string& variable, const StateExpression& source) = 0;
};

/// The fields behind the variables of formulas.
class StateFields {
 public:
  explicit StateFields(const StateVariables& variables) : variables_(&variables), sources_(variables.size()) {}

  /// A field that is offered again counts once.
  void offer(const std::string& variable, const StateField& source) {
    for (std::size_t k = 0; k < sources_.size(); ++k)
      if ((*variables_)[k].name == variable && std::ranges::count(sources_[k], source.field, &StateField::field) == 0)
        sources_[k].push_back(source);
  }
  /// Throws InputError where the formula names a variable without a field. `remedy(name)`: what to add to the scene.
  template <class Remedy>
  void require(const StateFormula& formula, const std::string& parameter, const Origin& where,
               const Remedy& remedy) const {
    for (std::size_t k = 0; k < sources_.size(); ++k) {
      const StateVariable& variable = (*variables_)[k];
      if (formula.names(k) && sources_[k].empty())
        throw InputError(where, "the formula of " + quoted(parameter) + " names " + quoted(variable.name),
                         "it is the " + variable.doc + ", which no part of the scene gives here",
                         remedy(variable.name));
    }
  }
  const std::vector<StateField>& of(std::size_t variable) const { return sources_[variable]; }
  double now(std::size_t variable, int entity) const {
    double sum = 0;
    for (const StateField& source : sources_[variable]) sum += source.now(entity);
    return sum;
  }

 private:
  const StateVariables* variables_;
  std::vector<std::vector<StateField>> sources_;  ///< of each variable
};

}  // namespace sprekk
