// How far the ridges of a fracture cell are from its centre.
#pragma once

#include "framework/mesh/mesh.hpp"

namespace sprekk {

/// The distance of the centre of a fracture cell from (the line of) one of its ridges, m: half of its length in a
/// plane.
double distance_to_ridge(const Mesh& mesh, int cell, int ridge);

}  // namespace sprekk
