// A permeability that is a formula of the state.
#pragma once

#include <array>
#include <memory>
#include <string>
#include <utility>
#include <vector>

#include "framework/assembly/state_fields.hpp"
#include "framework/mesh/mesh.hpp"

namespace sprekk::matrix_flow {

/// What a formula of the permeability may name.
const StateVariables& permeability_variables();

/// The permeability of each cell by formulas of its diagonal, and its derivatives by the variables that they name.
class StatePermeability {
 public:
  /// nullptr where the permeability is no formula. Throws InputError at `where` for a tensor that is not given by its
  /// diagonal.
  static std::unique_ptr<StatePermeability> find(const TensorData& data, const Mesh& mesh, Field& pressure,
                                                 const Origin& where);

  void offer(const std::string& variable, const StateField& source) { fields_.offer(variable, source); }
  void offer(const std::string& variable, const StateExpression& source);
  /// Throws InputError where a formula names what no part of the scene gives; `flow`: the name of the component.
  void require(const std::string& flow) const;

  /// Evaluates the formulas at the current state in this step. Returns whether a permeability has changed. Throws
  /// StateError, and then all values stay. Collective.
  bool evaluate(const StepTime& step);
  const std::vector<Tensor>& values() const { return values_; }  ///< m^2, one a cell
  std::size_t variable_count() const { return named_.size(); }   ///< that any formula names
  /// The derivatives of `values` by the k-th of these variables.
  const std::vector<Tensor>& by(std::size_t k) const { return by_[k]; }
  /// The derivatives of the k-th variable by each field that it depends on: cells × values of the field. Only rows of
  /// cells that the process owns are valid.
  std::vector<std::pair<const Field*, SparseMatrix>> derivatives_of_variable(std::size_t k) const;

 private:
  StatePermeability(const TensorData& data, const Mesh& mesh, Field& pressure, const Origin& where);
  bool take_state();

  const Mesh& mesh_;
  Origin where_;
  std::vector<StateFormula> diagonal_;  ///< one for each axis
  StateFields fields_;
  std::vector<std::vector<StateExpression>> expressions_;  ///< of each variable
  std::vector<std::size_t> named_;                         ///< variables
  std::vector<Vector> state_;                              ///< of each named variable, one a cell
  std::vector<Tensor> values_;
  std::vector<std::vector<Tensor>> by_;
};

}  // namespace sprekk::matrix_flow
