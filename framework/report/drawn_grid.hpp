// What the picture of a report shows of a file of fields.
#pragma once

#include <filesystem>

#include "framework/results/grid.hpp"

namespace sprekk {

/// In a plane the triangles or lines of the file. In space what is seen of them, projected without perspective by a
/// viewer in front of the left, front and top sides, who looks into the body: of the matrix the faces on its sides and
/// on walls of fractures that turn their backs to the viewer, the far ones first; of fractures the rims, as lines.
/// Throws std::runtime_error.
Grid drawn_grid(const std::filesystem::path& vtu);

}  // namespace sprekk
