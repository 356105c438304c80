// A property of rock that is a formula of the state.
#pragma once

#include <cstdint>
#include <memory>
#include <vector>

#include "components/capabilities/state_of_cells.hpp"

namespace sprekk {

/// A number for each cell by a formula of the state there, and its derivatives by the variables that it names.
class FormulaOfCells {
 public:
  /// nullptr where the datum is no formula. `history`: what it may name beside the state, nullptr for nothing.
  static std::unique_ptr<FormulaOfCells> find(const Data& data, const Mesh& mesh, const History* history = nullptr);

  const StateFormula& formula() const { return formula_; }
  StateOfCells& state() { return state_; }
  const StateOfCells& state() const { return state_; }

  /// Evaluates the formula at the present state, in this step, in the cells that `inside` flags (empty: in all).
  /// Returns whether a value may have changed. If it throws StateError, all values stay. Collective.
  bool evaluate(const StepTime& step, const std::vector<char>& inside = {});
  const Vector& values() const { return values_; }  ///< SI, one a cell; 0 in cells that are not inside
  /// The derivatives of the values by the k-th variable of the state.
  const Vector& by(std::size_t k) const { return by_[k]; }

 private:
  FormulaOfCells(const Data& data, const Mesh& mesh, const History* history);

  const Mesh& mesh_;
  StateFormula formula_;
  StateOfCells state_;
  std::uint64_t version_of_history_ = 0;
  Vector values_;
  std::vector<Vector> by_;
};

}  // namespace sprekk
