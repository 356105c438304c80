#include "components/matrix_flow/history_of_cells.hpp"

#include <algorithm>
#include <utility>

#include "framework/assembly/property.hpp"

namespace sprekk::matrix_flow {

std::unique_ptr<HistoryOfCells> HistoryOfCells::find(const HistoryOptions& options, const Mesh& mesh,
                                                     const std::vector<char>& inside) {
  std::unique_ptr<History> history = History::find(options, rock_variables(), cell_places(mesh), inside);
  return history ? std::unique_ptr<HistoryOfCells>(new HistoryOfCells(std::move(history), mesh)) : nullptr;
}

HistoryOfCells::HistoryOfCells(std::unique_ptr<History> history, const Mesh& mesh)
    : history_(std::move(history)), state_(mesh) {
  for (std::size_t k = 0; k < history_->variables().size(); ++k)
    state_.let_name(StateFormula(history_->remembered(k).expression, rock_variables(), cell_places(mesh)));
}

History::StateAt HistoryOfCells::state_at() const {
  return [this](int cell, std::span<double> values) {
    std::vector<double> state(values.size(), 0);
    state_.put(cell, state);
    std::ranges::copy(state, values.begin());
  };
}

void HistoryOfCells::show(const StepTime& step) {
  state_.take(step);
  history_->show({step.start, step.dt, step.end}, state_at());
}

void HistoryOfCells::begin_step(const StepTime& step) {
  state_.take(step);
  history_->begin_step({step.start, step.dt, step.end}, state_at());
}

void HistoryOfCells::remember(const StepTime& step) {
  state_.take(step);
  history_->remember(state_at());
}

}  // namespace sprekk::matrix_flow
