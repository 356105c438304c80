// The variables of the state in each cell, for formulas of properties of rock.
#pragma once

#include <functional>
#include <string>
#include <utility>
#include <vector>

#include "framework/assembly/state_fields.hpp"
#include "framework/mesh/mesh.hpp"

namespace sprekk {

/// What a formula of a property of rock may name.
const StateVariables& rock_variables();

/// The values of those of rock_variables() that some formulas name, in each cell, and their derivatives by fields.
class StateOfCells {
 public:
  explicit StateOfCells(const Mesh& mesh);

  /// Adds the variables that the formula names to those whose values are taken.
  void let_name(const StateFormula& formula);
  std::size_t variable_count() const { return named_.size(); }  ///< that any formula names
  /// The k-th of these, as an index of rock_variables().
  std::size_t variable(std::size_t k) const { return named_[k]; }
  bool names(const std::string& variable) const;

  void offer(const std::string& variable, const StateField& source) { fields_.offer(variable, source); }
  void offer(const std::string& variable, const StateExpression& source);
  bool has_all() const;  ///< whether all variables that are named have been offered
  /// Throws InputError at `where` when formulas of this parameter name what no part of the scene gives;
  /// `remedy(variable)`: what to add to the scene.
  void require(const std::string& parameter, const Origin& where,
               const std::function<std::string(const std::string&)>& remedy) const;

  /// Takes the present values, and returns whether any differ from those of the last call. While the start is settled
  /// (a step that ends where it begins), expressions keep their accepted values: strain is counted from the state that
  /// is being found. Collective.
  bool take(const StepTime& step);
  /// Puts the values of one cell in their places among all variables.
  void put(int cell, std::vector<double>& state) const;
  /// Calls `evaluate(cell, state)` with the values that were taken, in the cells that `inside` flags (empty: in all).
  /// If it throws DataError, the next call of `take` returns true.
  void visit(const std::vector<char>& inside, const std::function<void(int, std::vector<double>&)>& evaluate);
  void forget();  ///< lets the next call of `take` return true
  /// Derivatives of the k-th variable by each field on which it depends, cells × values of the field; complete in the
  /// rows of cells that the process owns.
  std::vector<std::pair<const Field*, SparseMatrix>> derivatives_of_variable(std::size_t k) const;

 private:
  const Mesh& mesh_;
  StateFields fields_;
  std::vector<std::vector<StateExpression>> expressions_;  ///< of each variable
  std::vector<std::size_t> named_;                         ///< variables
  std::vector<Vector> values_;                             ///< of each named variable, one a cell
  bool is_settling_ = false;
};

}  // namespace sprekk
