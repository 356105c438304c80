// How far fields of two runs in space are apart.
#pragma once

#include "framework/compare/field_difference.hpp"
#include "framework/output/vtk_module/vtk_module.hpp"

namespace sprekk {

/// Compares the bodies of two grids entity by entity on equal meshes, else values of cells at the centres of the mesh
/// that has more of them. Surfaces (fractures) are compared on equal meshes only.
GridDifference body_difference(const GridData& one, const GridData& other);

}  // namespace sprekk
