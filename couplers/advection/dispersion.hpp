// Mechanical dispersion: how flow through pores of many sizes, or between rough walls, spreads what fluid carries.
#pragma once

#include <vector>

#include "framework/mesh/mesh.hpp"

namespace sprekk::couplers {

/// Dispersivities, m: along the flow and across it (Scheidegger 1961).
struct Dispersivity {
  double along = 0, across = 0;
  bool is_zero() const { return along == 0 && across == 0; }
};

/// alpha_T |q| I + (alpha_L − alpha_T) q q^T/|q| of each cell, m^2/s, with the Darcy velocity q that is exact for a
/// constant one. `fluxes`: through each face, out of face_cells[f][0], m^2/s (in space m^3/s).
std::vector<Tensor> dispersion_in_rock(const Mesh& mesh, const Vector& fluxes, const Dispersivity& lengths);
/// The same of each fracture cell, with the flux q along it, m^3/s. `fluxes`: through each ridge, from its first to its
/// second cell, m^2/s (in space m^3/s).
std::vector<Tensor> dispersion_in_fractures(const Mesh& mesh, const Vector& fluxes, const Dispersivity& lengths);

}  // namespace sprekk::couplers
