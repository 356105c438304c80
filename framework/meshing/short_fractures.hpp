// Which fractures are shorter than their cells.
#pragma once

#include <string>

#include "framework/meshing/geometry.hpp"

namespace sprekk {

/// A note on the fractures that are shorter than the cells that the options ask for at them, the shortest with its
/// figures, or "" if there are none. Each has a single cell, between two ends.
std::string note_on_short_fractures(const Geometry& geometry, const MeshOptions& options);

}  // namespace sprekk
