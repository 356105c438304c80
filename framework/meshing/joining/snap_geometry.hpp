// Cleans a geometry that was digitized: what nearly touches is joined.
#pragma once

#include <string>
#include <vector>

#include "framework/meshing/geometry.hpp"

namespace sprekk {

/// Joins points, fractures, edges of regions and sides that are nearer to one another than snap_length(), and leaves
/// out what lies on a fracture already, also if that divides a fracture (NAME, NAME_2, …): of two that share a part,
/// the longer one keeps it. Fractures and regions that are not concerned keep all bits. Afterwards the geometry says
/// how far it is joined. Returns notes on what was done, none if nothing was. Throws InputError for a length above that
/// of the shortest cells, and for regions that vanish. Geometries that validate_geometry refuses anyhow, and those of
/// mesh files, stay as they are. In space nothing is joined.
std::vector<std::string> snap_geometry(Geometry& geometry, const MeshOptions& options);

}  // namespace sprekk
