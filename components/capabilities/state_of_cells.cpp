#include "components/capabilities/state_of_cells.hpp"

#include <algorithm>

#include "framework/field/ownership.hpp"
#include "framework/matrix_of.hpp"

namespace sprekk {

const StateVariables& rock_variables() {
  static const StateVariables variables = {{"p", "Pa", "pressure of the fluid"},
                                           {"eps_v", "", "volumetric strain, positive where the rock expands"},
                                           {"T", "K", "temperature"}};
  return variables;
}

StateOfCells::StateOfCells(const Mesh& mesh)
    : mesh_(mesh), fields_(rock_variables()), expressions_(rock_variables().size()) {}

void StateOfCells::let_name(const StateFormula& formula) {
  for (std::size_t k = 0; k < rock_variables().size(); ++k)
    if (formula.names(k) && std::ranges::count(named_, k) == 0) named_.push_back(k);
  values_.resize(named_.size());
}

bool StateOfCells::names(const std::string& variable) const {
  return std::ranges::any_of(named_, [&](std::size_t k) { return rock_variables()[k].name == variable; });
}

void StateOfCells::offer(const std::string& variable, const StateExpression& source) {
  for (std::size_t k = 0; k < expressions_.size(); ++k)
    if (rock_variables()[k].name == variable &&
        std::ranges::count(expressions_[k], source.expression, &StateExpression::expression) == 0)
      expressions_[k].push_back(source);
}

bool StateOfCells::has_all() const {
  return std::ranges::all_of(named_, [&](std::size_t k) { return !fields_.of(k).empty() || !expressions_[k].empty(); });
}

void StateOfCells::require(const std::string& parameter, const Origin& where,
                           const std::function<std::string(const std::string&)>& remedy) const {
  for (const std::size_t k : named_) {
    if (!fields_.of(k).empty() || !expressions_[k].empty()) continue;
    const StateVariable& variable = rock_variables()[k];
    throw InputError(where, "the formula of " + quoted(parameter) + " names " + quoted(variable.name),
                     "it is the " + variable.doc + ", which no part of the scene gives here", remedy(variable.name));
  }
}

bool StateOfCells::take(const StepTime& step) {
  bool has_changed = false;
  is_settling_ = step.dt > 0 && step.end == step.start;
  for (std::size_t k = 0; k < named_.size(); ++k) {
    Vector values(mesh_.cell_count());
    for (int c = 0; c < mesh_.cell_count(); ++c) values[c] = fields_.now(named_[k], c);
    for (const StateExpression& source : expressions_[named_[k]]) {
      if (source.expression->constant.size() == 0) continue;  // before the first step
      Vector value = is_settling_ ? source.expression->accepted() : source.expression->now();
      exchange(mesh_, Location::cell, 1, value);
      values += source.factors.cwiseProduct(value);
    }
    if (values_[k].size() == values.size() && values_[k] == values) continue;
    values_[k] = std::move(values);
    has_changed = true;
  }
  return has_changed;
}

void StateOfCells::forget() {
  for (Vector& kept : values_) kept.resize(0);
}

void StateOfCells::put(int cell, std::vector<double>& state) const {
  for (std::size_t k = 0; k < named_.size(); ++k) state[named_[k]] = values_[k][cell];
}

void StateOfCells::visit(const std::vector<char>& inside,
                         const std::function<void(int, std::vector<double>&)>& evaluate) {
  std::vector<double> state(rock_variables().size(), 0);
  try {
    for (int cell = 0; cell < mesh_.cell_count(); ++cell) {
      if (!inside.empty() && !inside[cell]) continue;
      put(cell, state);
      evaluate(cell, state);
    }
  } catch (const DataError&) {
    forget();
    throw;
  }
}

std::vector<std::pair<const Field*, SparseMatrix>> StateOfCells::derivatives_of_variable(std::size_t k) const {
  std::vector<std::pair<const Field*, SparseMatrix>> all;
  for (const StateField& source : fields_.of(named_[k])) {
    const int components = source.field->spec().components;
    std::vector<Triplet> entries;
    for (int c = 0; c < mesh_.cell_count(); ++c)
      entries.emplace_back(c, components * c + source.component, source.factor);
    all.emplace_back(source.field, matrix_of(mesh_.cell_count(), source.field->size(), entries));
  }
  for (const StateExpression& source : expressions_[named_[k]])
    if (!is_settling_ && source.expression->constant.size() > 0)
      for (const LinearExpression::Term& term : source.expression->terms)
        all.emplace_back(term.field, source.factors.asDiagonal() * term.matrix.entries());
  return all;
}

}  // namespace sprekk
