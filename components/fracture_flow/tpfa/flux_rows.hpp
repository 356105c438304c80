// The rows of the fluxes along fractures while they are assembled.
#pragma once

#include <vector>

#include "components/fracture_flow/tpfa/fracture_flow.hpp"

namespace sprekk::fracture_flow {

/// of_flux Q + drop = 0, one row for each ridge, with derivatives.
struct FractureFlow::FluxRows {
  double dt;
  Vector of_flux, drop;
  std::vector<Triplet> by_flux, by_pressure, by_aperture;  ///< by_flux: without of_flux on the diagonal
  std::vector<Triplet> by_density = {};                    ///< derivatives by the density of each cell
  double largest_pressure = 0;
};

}  // namespace sprekk::fracture_flow
