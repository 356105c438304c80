// A specific storage that is a formula of the state.
#pragma once

#include <memory>
#include <vector>

#include "components/capabilities/state_of_cells.hpp"

namespace sprekk::matrix_flow {

/// A volume of rock stores the integral of its specific storage S over the pressure p, from the initial pressure, with
/// all other variables at their present values:
///   zeta(p, …) = integral of S(p', …) dp' from p_0 to p,
/// by Gauss-Legendre in equal pieces. So it follows from the state alone, and not from the path to it.
class StorageFormula {
 public:
  /// Returns nullptr if the datum is no formula. Throws InputError at `where` for a formula with memory.
  static std::unique_ptr<StorageFormula> find(const Data& data, const Mesh& mesh, const Field& pressure,
                                              const History* history, const Origin& where);

  StateOfCells& state() { return state_; }
  const StateOfCells& state() const { return state_; }
  /// Evaluates zeta at the present state, in this step, in the cells that `inside` flags (empty: in all). Returns
  /// whether a value may have changed. If it throws StateError, all values stay. Collective.
  bool evaluate(const StepTime& step, const Vector& initial_pressure, const std::vector<char>& inside);
  const Vector& stored() const { return stored_; }            ///< zeta, one a cell
  const Vector& by_pressure() const { return by_pressure_; }  ///< 1/Pa
  /// The derivatives by the k-th variable of the state, which is not the pressure.
  const Vector& by(std::size_t k) const { return by_[k]; }

 private:
  StorageFormula(const Data& data, const Mesh& mesh, const Field& pressure, const History* history);

  const Mesh& mesh_;
  const Field& pressure_;
  StateFormula formula_;
  StateOfCells state_;
  Vector pressures_, stored_, by_pressure_;
  std::vector<Vector> by_;
};

}  // namespace sprekk::matrix_flow
