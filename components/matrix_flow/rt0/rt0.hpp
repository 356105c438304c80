// Mixed-hybrid finite elements of lowest order.
#pragma once

#include <vector>

#include "components/matrix_flow/flux_operators.hpp"

namespace sprekk::matrix_flow {

/// Discretizes the flux by the hybridized mixed method of Raviart and Thomas (Arnold and Brezzi, RAIRO Modél. Math.
/// Anal. Numér. 19 (1985) 7): fluxes follow from the pressures of cells and of their inner faces, which are unknowns
/// (FluxOperators::faces). The flux through an inner face is half of the outflow from one cell less half of that from
/// the other, so both cells have the same flux to the bit, also before the equations of the faces hold. The pressures
/// of walls, and of boundary faces with a prescribed flux, are eliminated within their cell. Arguments as for
/// discretize_mpfa; all rows are complete, whatever `nodes` says. In a plane, near the tip of a fracture the equations
/// of a cell contain the singular flow around it (TipTerms). Exact for linear pressures on any mesh; the mobility may
/// be discontinuous and anisotropic. Throws std::runtime_error if a mobility is not positive definite.
FluxOperators discretize_rt0(const Mesh& mesh, const std::vector<Tensor>& mobility,
                             const std::vector<FlowCondition>& conditions, const std::vector<char>& nodes = {});

/// As discretize_rt0, with these shares of mass_for_short_steps, one a cell.
FluxOperators discretize_rt0_for_short_steps(const Mesh& mesh, const std::vector<Tensor>& mobility,
                                             const std::vector<FlowCondition>& conditions,
                                             const std::vector<double>& shares);

/// As discretize_rt0, with lumped_flux_mass, and linear pressures around tips.
FluxOperators discretize_lumped_rt0(const Mesh& mesh, const std::vector<Tensor>& mobility,
                                    const std::vector<FlowCondition>& conditions, const std::vector<char>& nodes = {});

}  // namespace sprekk::matrix_flow
