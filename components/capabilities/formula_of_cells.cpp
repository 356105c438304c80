#include "components/capabilities/formula_of_cells.hpp"

#include <algorithm>
#include <utility>

#include "framework/assembly/property.hpp"

namespace sprekk {

std::unique_ptr<FormulaOfCells> FormulaOfCells::find(const std::vector<Data>& data, const Mesh& mesh,
                                                     const History* history) {
  std::unique_ptr<FormulaOfCells> found(new FormulaOfCells(data, mesh, history));
  return std::ranges::any_of(found->formulas_, &StateFormula::is_formula) ? std::move(found) : nullptr;
}

FormulaOfCells::FormulaOfCells(const std::vector<Data>& data, const Mesh& mesh, const History* history)
    : mesh_(mesh), state_(mesh) {
  const std::vector<Place> places = cell_places(mesh);
  for (const Data& datum : data) {
    formulas_.emplace_back(datum, rock_variables(), places, history);
    state_.let_name(formulas_.back());
  }
}

std::uint32_t FormulaOfCells::recalled() const {
  std::uint32_t recalled = 0;
  for (const StateFormula& formula : formulas_) recalled |= formula.recalled();
  return recalled;
}

bool FormulaOfCells::evaluate(const StepTime& step, const std::vector<char>& inside,
                              const std::function<void(int, double)>& check) {
  bool has_changed = state_.take(step);
  std::uint64_t version = 0;
  for (StateFormula& formula : formulas_) {
    has_changed = formula.set_time(step) || has_changed;
    version += formula.version_of_history();
  }
  if (!has_changed && version == version_of_history_ && !values_.empty()) return false;
  std::vector<Vector> values(formulas_.size(), Vector::Zero(mesh_.cell_count()));
  std::vector<std::vector<Vector>> by(formulas_.size(), {state_.variable_count(), values[0]});
  std::vector<double> of_state(rock_variables().size());
  state_.visit(inside, [&](int cell, std::vector<double>& state) {
    for (std::size_t i = 0; i < formulas_.size(); ++i) {
      values[i][cell] = formulas_[i].at(cell, state, of_state);
      if (check) check(cell, values[i][cell]);
      for (std::size_t k = 0; k < by[i].size(); ++k) by[i][k][cell] = of_state[state_.variable(k)];
    }
  });
  version_of_history_ = version;
  values_ = std::move(values);
  by_ = std::move(by);
  return true;
}

}  // namespace sprekk
