// The resistance of a well in the rock of a plane before the flow around it is steady on the scale of its cell.
#pragma once

#include <optional>

#include "components/capabilities/fluid_fluxes.hpp"
#include "couplers/well_exchange/early_resistance.hpp"
#include "framework/discretization/plane/point_source.hpp"

namespace sprekk::couplers {

/// `bore`: the radius of the bore hole in the metric of rho, m. None where a cell of the source touches the boundary or
/// a fracture. Throws std::invalid_argument as WellPatch does.
std::optional<EarlyResistance> early_resistance(const Mesh& mesh, const MatrixFluxes& fluxes, const PointSource& source,
                                                const Tensor& mobility, double bore);

}  // namespace sprekk::couplers
