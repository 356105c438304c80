#include "components/matrix_flow/state_permeability.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <utility>

#include "framework/assembly/property.hpp"
#include "framework/config/expression.hpp"
#include "framework/invariants.hpp"

namespace sprekk::matrix_flow {

std::unique_ptr<StatePermeability> StatePermeability::find(const TensorData& data, const Mesh& mesh, Field& pressure,
                                                           const Origin& where, const History* history) {
  std::unique_ptr<StatePermeability> found(new StatePermeability(data, mesh, pressure, where, history));
  const bool is_formula =
      found->state_.variable_count() > 0 || std::ranges::any_of(found->diagonal_, &StateFormula::is_formula);
  if (is_formula && !data.is_diagonal())
    throw InputError(where, "a permeability that is a formula of the state has entries beside its diagonal",
                     "a formula is taken for each axis alone", "give one formula, or one each for 'xx' and 'yy'");
  return is_formula ? std::move(found) : nullptr;
}

StatePermeability::StatePermeability(const TensorData& data, const Mesh& mesh, Field& pressure, const Origin& where,
                                     const History* history)
    : mesh_(mesh), where_(where), state_(mesh) {
  state_.offer("p", StateField{&pressure});
  const std::vector<Place> places = cell_places(mesh);
  for (const Data& component : data.component) {
    const StateFormula formula(component, rock_variables(), places, history);
    state_.let_name(formula);
    if (diagonal_.size() < dimension) diagonal_.push_back(formula);
  }
}

bool StatePermeability::evaluate(const StepTime& step) {
  bool has_changed = state_.take(step);
  for (StateFormula& formula : diagonal_) has_changed = formula.set_time(step) || has_changed;
  std::uint64_t version = 0;
  for (const StateFormula& formula : diagonal_) version += formula.version_of_history();
  if (!has_changed && version == version_of_history_ && !values_.empty()) return false;
  std::vector<Tensor> values(mesh_.cell_count(), Tensor::Zero());
  std::vector<std::vector<Tensor>> by(state_.variable_count(), values);
  std::vector<double> state(rock_variables().size(), 0), of_state(state.size());
  const auto evaluate_cell = [&](int c) {
    state_.put(c, state);
    for (int axis = 0; axis < dimension; ++axis) {
      const double value = diagonal_[axis].at(c, state, of_state);
      if (!(value > 0))
        throw StateError(
            fmt::format("{}: 'permeability' is {} m^2 at {} (fluid could not flow there) keep it above 0: "
                        "\"max(1e-22 m^2, …)\"",
                        where_.text(), value, to_text(mesh_.cell_center[c])));
      values[c](axis, axis) = value;
      for (std::size_t k = 0; k < by.size(); ++k) by[k][c](axis, axis) = of_state[state_.variable(k)];
    }
  };
  try {
    for (int c = 0; c < mesh_.cell_count(); ++c) evaluate_cell(c);
  } catch (const DataError&) {
    state_.forget();  // so that the next call does not take them for evaluated
    throw;
  }
  version_of_history_ = version;
  const bool differs = values != values_;
  values_ = std::move(values);
  by_ = std::move(by);
  return differs;
}

}  // namespace sprekk::matrix_flow
