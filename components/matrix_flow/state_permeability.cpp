#include "components/matrix_flow/state_permeability.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <utility>

#include "framework/assembly/property.hpp"
#include "framework/config/expression.hpp"
#include "framework/field/ownership.hpp"
#include "framework/invariants.hpp"

namespace sprekk::matrix_flow {

const StateVariables& permeability_variables() {
  static const StateVariables variables = {{"p", "Pa", "pressure of the fluid"},
                                           {"eps_v", "", "volumetric strain, positive where the rock expands"},
                                           {"T", "K", "temperature"}};
  return variables;
}

std::unique_ptr<StatePermeability> StatePermeability::find(const TensorData& data, const Mesh& mesh, Field& pressure,
                                                           const Origin& where) {
  std::unique_ptr<StatePermeability> found(new StatePermeability(data, mesh, pressure, where));
  if (!found->named_.empty() && !data.is_diagonal())
    throw InputError(where, "a permeability that is a formula of the state has entries beside its diagonal",
                     "a formula is taken for each axis alone", "give one formula, or one each for 'xx' and 'yy'");
  return found->named_.empty() ? nullptr : std::move(found);
}

StatePermeability::StatePermeability(const TensorData& data, const Mesh& mesh, Field& pressure, const Origin& where)
    : mesh_(mesh), where_(where), fields_(permeability_variables()), expressions_(permeability_variables().size()) {
  const std::vector<Place> places = cell_places(mesh);
  for (const Data& component : data.component) {
    const StateFormula formula(component, permeability_variables(), places);
    for (std::size_t k = 0; k < permeability_variables().size(); ++k)
      if (formula.names(k) && std::ranges::count(named_, k) == 0) named_.push_back(k);
    if (diagonal_.size() < dimension) diagonal_.push_back(formula);
  }
  state_.resize(named_.size());
  fields_.offer("p", {&pressure});
}

void StatePermeability::offer(const std::string& variable, const StateExpression& source) {
  for (std::size_t k = 0; k < expressions_.size(); ++k)
    if (permeability_variables()[k].name == variable &&
        std::ranges::count(expressions_[k], source.expression, &StateExpression::expression) == 0)
      expressions_[k].push_back(source);
}

void StatePermeability::require(const std::string& flow) const {
  for (const std::size_t k : named_) {
    if (!fields_.of(k).empty() || !expressions_[k].empty()) continue;
    const StateVariable& variable = permeability_variables()[k];
    throw InputError(where_, "the formula of 'permeability' names " + quoted(variable.name),
                     "it is the " + variable.doc + ", which no part of the scene gives here",
                     variable.name == "T"
                         ? "add a component of the heat in the rock, and a coupler heat_advection with '" + flow + "'"
                         : "add a rock, and '- {type: biot, between: [" + flow + ", ROCK]}' to 'couplers:'");
  }
}

bool StatePermeability::take_state() {
  bool has_changed = false;
  for (std::size_t k = 0; k < named_.size(); ++k) {
    Vector values(mesh_.cell_count());
    for (int c = 0; c < mesh_.cell_count(); ++c) values[c] = fields_.now(named_[k], c);
    for (const StateExpression& source : expressions_[named_[k]]) {
      if (source.expression->constant.size() == 0) continue;  // before the first step
      Vector value = source.expression->now();
      exchange(mesh_, Location::cell, 1, value);
      values += source.factors.cwiseProduct(value);
    }
    if (state_[k].size() == values.size() && state_[k] == values) continue;
    state_[k] = std::move(values);
    has_changed = true;
  }
  return has_changed;
}

bool StatePermeability::evaluate(const StepTime& step) {
  bool has_changed = take_state();
  for (StateFormula& formula : diagonal_) has_changed = formula.set_time(step) || has_changed;
  if (!has_changed && !values_.empty()) return false;
  std::vector<Tensor> values(mesh_.cell_count(), Tensor::Zero());
  std::vector<std::vector<Tensor>> by(named_.size(), values);
  std::vector<double> state(permeability_variables().size(), 0), of_state(state.size());
  const auto evaluate_cell = [&](int c) {
    for (std::size_t k = 0; k < named_.size(); ++k) state[named_[k]] = state_[k][c];
    for (int axis = 0; axis < dimension; ++axis) {
      const double value = diagonal_[axis].at(c, state, of_state);
      if (!(value > 0))
        throw StateError(
            fmt::format("{}: 'permeability' is {} m^2 at {} (fluid could not flow there) keep it above 0: "
                        "\"max(1e-22 m^2, …)\"",
                        where_.text(), value, to_text(mesh_.cell_center[c])));
      values[c](axis, axis) = value;
      for (std::size_t k = 0; k < named_.size(); ++k) by[k][c](axis, axis) = of_state[named_[k]];
    }
  };
  try {
    for (int c = 0; c < mesh_.cell_count(); ++c) evaluate_cell(c);
  } catch (const DataError&) {
    for (Vector& kept : state_) kept.resize(0);  // so that the next call does not take them for evaluated
    throw;
  }
  const bool differs = values != values_;
  values_ = std::move(values);
  by_ = std::move(by);
  return differs;
}

std::vector<std::pair<const Field*, SparseMatrix>> StatePermeability::derivatives_of_variable(std::size_t k) const {
  std::vector<std::pair<const Field*, SparseMatrix>> all;
  for (const StateField& source : fields_.of(named_[k])) {
    const int components = source.field->spec().components;
    std::vector<Triplet> entries;
    for (int c = 0; c < mesh_.cell_count(); ++c)
      entries.emplace_back(c, components * c + source.component, source.factor);
    SparseMatrix of_field(mesh_.cell_count(), source.field->size());
    of_field.setFromTriplets(entries.begin(), entries.end());
    all.emplace_back(source.field, std::move(of_field));
  }
  for (const StateExpression& source : expressions_[named_[k]])
    if (source.expression->constant.size() > 0)
      for (const LinearExpression::Term& term : source.expression->terms)
        all.emplace_back(term.field, source.factors.asDiagonal() * term.matrix.entries());
  return all;
}

}  // namespace sprekk::matrix_flow
