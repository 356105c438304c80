// What the picture of a report shows of a file of fields.
#pragma once

#include <array>
#include <filesystem>
#include <string>
#include <vector>

#include "framework/results/grid.hpp"

namespace sprekk {

/// In a plane the triangles or lines of the file. In space what is seen of them, projected without perspective by a
/// viewer in front of the left, front and top sides, who looks into the body: of the matrix the faces on its sides and
/// on walls of fractures that turn their backs to the viewer, the far ones first; of fractures the rims, as lines.
/// Throws std::runtime_error.
Grid drawn_grid(const std::filesystem::path& vtu);

/// An edge of the box around a body, along which one coordinate changes from `low` to `high` (m).
struct DrawnEdge {
  std::string coordinate;          ///< "x", "y" or "z"
  std::array<double, 2> from, to;  ///< in the picture
  double low, high;
};

/// In space the three edges at the border of the picture, along which a report writes what x, y and z are. None in a
/// plane. Throws std::runtime_error.
std::vector<DrawnEdge> drawn_edges(const std::filesystem::path& vtu);

}  // namespace sprekk
