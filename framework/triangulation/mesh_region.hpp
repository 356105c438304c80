// Triangles of wanted sizes in a region of the plane.
#pragma once

#include <array>
#include <functional>
#include <vector>

#include "framework/mesh/ring.hpp"
#include "framework/types.hpp"

namespace sprekk {

/// A region of the plane, given by lines on its boundary and inside of it.
struct RegionDrawing {
  /// A straight line between two points.
  struct Line {
    std::array<int, 2> points;
    bool is_boundary;  ///< whether the line bounds the region; otherwise it lies inside
    bool is_whole;     ///< whether the line must stay one edge
  };
  std::vector<Point> points;  ///< multiples of 2^-32 between -1 and 1, as those of CanonicalDrawing
  std::vector<Line> lines;    ///< meet in their ends only
};

/// The triangles of a region, in the frame of its drawing.
struct RegionMesh {
  std::vector<Point> points;              ///< those of the drawing first
  std::vector<Ring> triangles;            ///< counter-clockwise
  std::vector<std::vector<int>> on_line;  ///< points along each line, its ends included
  int first_inside;                       ///< number of the first point that is on no line
};

/// Divides the lines, makes a Delaunay triangulation with their edges, and adds points from the lines inward, where
/// they form nearly equilateral triangles with existing edges (Rebay, J. Comput. Phys. 106 (1993) 125), until the
/// circumradii fit to `size`, the wanted edge length at a place. The slope of `size` should not exceed a half. The same
/// drawing gives the same mesh. Throws std::runtime_error when lines meet other than in their ends, or when boundaries
/// are not closed.
RegionMesh mesh_region(const RegionDrawing& drawing, const std::function<double(const Point&)>& size);

}  // namespace sprekk
