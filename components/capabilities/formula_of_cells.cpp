#include "components/capabilities/formula_of_cells.hpp"

#include <utility>

#include "framework/assembly/property.hpp"

namespace sprekk {

std::unique_ptr<FormulaOfCells> FormulaOfCells::find(const Data& data, const Mesh& mesh, const History* history) {
  std::unique_ptr<FormulaOfCells> found(new FormulaOfCells(data, mesh, history));
  return found->formula_.is_formula() ? std::move(found) : nullptr;
}

FormulaOfCells::FormulaOfCells(const Data& data, const Mesh& mesh, const History* history)
    : mesh_(mesh), formula_(data, rock_variables(), cell_places(mesh), history), state_(mesh) {
  state_.let_name(formula_);
}

bool FormulaOfCells::evaluate(const StepTime& step, const std::vector<char>& inside) {
  const bool has_changed = state_.take(step), is_other_time = formula_.set_time(step);
  const std::uint64_t version = formula_.version_of_history();
  const bool is_other_history = version != version_of_history_;
  if (!has_changed && !is_other_time && !is_other_history && values_.size() > 0) return false;
  Vector values = Vector::Zero(mesh_.cell_count());
  std::vector<Vector> by(state_.variable_count(), values);
  std::vector<double> state(rock_variables().size(), 0), of_state(state.size());
  try {
    for (int c = 0; c < mesh_.cell_count(); ++c) {
      if (!inside.empty() && !inside[c]) continue;
      state_.put(c, state);
      values[c] = formula_.at(c, state, of_state);
      for (std::size_t k = 0; k < by.size(); ++k) by[k][c] = of_state[state_.variable(k)];
    }
  } catch (const DataError&) {
    state_.forget();  // so that the next call does not take it for evaluated
    throw;
  }
  version_of_history_ = version;
  values_ = std::move(values);
  by_ = std::move(by);
  return true;
}

}  // namespace sprekk
