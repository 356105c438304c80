// The memory of formulas for properties of rock.
#pragma once

#include <memory>
#include <vector>

#include "components/capabilities/state_of_cells.hpp"
#include "framework/assembly/history/history.hpp"

namespace sprekk::matrix_flow {

/// A history of the state in each cell.
class HistoryOfCells {
 public:
  /// nullptr where the scene wants nothing to be remembered.
  static std::unique_ptr<HistoryOfCells> find(const HistoryOptions& options, const Mesh& mesh,
                                              const std::vector<char>& inside);

  History& history() { return *history_; }
  StateOfCells& state() { return state_; }
  /// The functions of History of the same name, with the present state. Collective.
  void show(const StepTime& step);
  void begin_step(const StepTime& step);
  void remember(const StepTime& step);

 private:
  HistoryOfCells(std::unique_ptr<History> history, const Mesh& mesh);
  History::StateAt state_at() const;

  std::unique_ptr<History> history_;
  StateOfCells state_;
};

}  // namespace sprekk::matrix_flow
