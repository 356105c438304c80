// Refuses geometries that cannot be meshed.
#pragma once

#include "framework/meshing/geometry.hpp"

namespace sprekk {

/// Throws InputError, with origin, for everything that cannot be meshed:
/// - an empty box, and fractures or polygons that are degenerate or lie outside of it;
/// - fractures that overlap, meet each other on the boundary, or meet themselves or the boundary (other than with an
///   end);
/// - sizes that are not positive numbers, and meshes of more than 20 million cells.
///
/// One error has all that is wrong with fractures and regions.
void validate_geometry(const Geometry& geometry, const MeshOptions& options);

}  // namespace sprekk
