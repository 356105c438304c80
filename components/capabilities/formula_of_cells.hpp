// Properties of rock that are formulas of the state.
#pragma once

#include <cstdint>
#include <functional>
#include <memory>
#include <vector>

#include "components/capabilities/state_of_cells.hpp"

namespace sprekk {

/// One or more numbers for each cell by formulas of the state there, and their derivatives by the variables that any of
/// them names.
class FormulaOfCells {
 public:
  /// nullptr where no datum is a formula. `history`: what they may name beside the state, nullptr for nothing.
  static std::unique_ptr<FormulaOfCells> find(const std::vector<Data>& data, const Mesh& mesh,
                                              const History* history = nullptr);

  std::uint32_t recalled() const;  ///< by any of the formulas
  StateOfCells& state() { return state_; }
  const StateOfCells& state() const { return state_; }

  /// Evaluates the formulas at the present state, in this step, in the cells that `inside` flags (empty: in all).
  /// `check(cell, value)`: may throw StateError. Returns whether a value may have changed. If it throws StateError, all
  /// values stay. Collective.
  bool evaluate(const StepTime& step, const std::vector<char>& inside = {},
                const std::function<void(int, double)>& check = {});
  /// Of the i-th formula: SI, one a cell; 0 in cells that are not inside.
  const Vector& values(std::size_t i = 0) const { return values_[i]; }
  /// The derivatives of the values of the i-th formula by the k-th variable of the state.
  const Vector& by(std::size_t k, std::size_t i = 0) const { return by_[i][k]; }

 private:
  FormulaOfCells(const std::vector<Data>& data, const Mesh& mesh, const History* history);

  const Mesh& mesh_;
  std::vector<StateFormula> formulas_;
  StateOfCells state_;
  std::uint64_t version_of_history_ = 0;
  std::vector<Vector> values_;
  std::vector<std::vector<Vector>> by_;
};

}  // namespace sprekk
