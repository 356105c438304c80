// Nodal forces of tractions and of the stress offset.
#pragma once

#include "components/fine_fracture/quarter_point/fine_mesh.hpp"
#include "components/fine_fracture/quarter_point/loads.hpp"

namespace sprekk::fine_fracture {

/// The integrals of t . v over the outline and the walls, minus that of s : eps(v) over the domain; (x, y) per node,
/// N/m.
Vector external_forces(const FineGeometry& geometry, const FineMesh& mesh, const FineLoads& loads);

}  // namespace sprekk::fine_fracture
