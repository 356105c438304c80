// A permeability that is a formula of the state.
#pragma once

#include <cstdint>
#include <memory>
#include <utility>
#include <vector>

#include "components/capabilities/state_of_cells.hpp"

namespace sprekk::matrix_flow {

/// The permeability of each cell by formulas of its diagonal, and its derivatives by the variables that they name.
class StatePermeability {
 public:
  /// Returns nullptr if the permeability is no formula. Throws InputError at `where` for a tensor that is not given by
  /// its diagonal. `history`: what formulas may name beside the state, nullptr for nothing.
  static std::unique_ptr<StatePermeability> find(const TensorData& data, const Mesh& mesh, Field& pressure,
                                                 const Origin& where, const History* history);

  StateOfCells& state() { return state_; }
  const std::vector<StateFormula>& formulas() const { return diagonal_; }

  /// Evaluates the formulas at the current state in this step. Returns whether a permeability has changed. Throws
  /// StateError, and then all values stay. Collective.
  bool evaluate(const StepTime& step);
  const std::vector<Tensor>& values() const { return values_; }  ///< m^2, one a cell
  /// The derivatives of `values` by the k-th variable of the state.
  const std::vector<Tensor>& by(std::size_t k) const { return by_[k]; }

 private:
  StatePermeability(const TensorData& data, const Mesh& mesh, Field& pressure, const Origin& where,
                    const History* history);

  const Mesh& mesh_;
  Origin where_;
  std::vector<StateFormula> diagonal_;  ///< one for each axis
  StateOfCells state_;
  std::uint64_t version_of_history_ = 0;
  std::vector<Tensor> values_;
  std::vector<std::vector<Tensor>> by_;
};

}  // namespace sprekk::matrix_flow
