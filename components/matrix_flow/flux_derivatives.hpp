// Derivatives of fluxes by the variables of the mobility.
#pragma once

#include <functional>
#include <vector>

#include "components/matrix_flow/flux_operators.hpp"
#include "components/matrix_flow/rediscretize.hpp"

namespace sprekk::matrix_flow {

/// The vectors to which FluxOperators are applied.
struct FluxState {
  Vector cells;     ///< Pa, one a cell: pressures less the weight of fluid
  Vector boundary;  ///< one a face: prescribed pressures and fluxes, those through walls among them
  Vector changes;   ///< Pa, of prescribed pressures along faces
};

/// Derivatives of fluxes (m^2/s) and of pressures at sides and walls (Pa) by a variable of each cell.
struct FluxDerivatives {
  SparseMatrix flux, trace;  ///< faces × cells
};

/// One for each variable k, where `by[k]` has the derivatives of the mobility of each cell by it. `nodes` as for the
/// discretization.
using DifferentiateFluxes =
    std::function<std::vector<FluxDerivatives>(const FlowInputs& flow, const std::vector<char>& nodes,
                                               const FluxState& state, const std::vector<std::vector<Tensor>>& by)>;

/// Accumulates the entries of such derivatives.
class FluxDerivativeEntries {
 public:
  explicit FluxDerivativeEntries(std::size_t variables) : flux_(variables), trace_(variables) {}
  void add_to_flux(std::size_t variable, int face, int cell, double value) {
    if (value != 0) flux_[variable].emplace_back(face, cell, value);
  }
  void add_to_trace(std::size_t variable, int face, int cell, double value) {
    if (value != 0) trace_[variable].emplace_back(face, cell, value);
  }
  std::vector<FluxDerivatives> take(const Mesh& mesh) const {
    std::vector<FluxDerivatives> all(flux_.size());
    for (std::size_t k = 0; k < all.size(); ++k)
      for (const auto& [entries, matrix] : {std::pair{&flux_[k], &all[k].flux}, {&trace_[k], &all[k].trace}}) {
        matrix->resize(mesh.face_count(), mesh.cell_count());
        matrix->setFromTriplets(entries->begin(), entries->end());
      }
    return all;
  }

 private:
  std::vector<std::vector<Triplet>> flux_, trace_;  ///< of each variable
};

}  // namespace sprekk::matrix_flow
