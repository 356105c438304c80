// Triangles of wanted sizes in a region of the plane.
#pragma once

#include <array>
#include <functional>
#include <vector>

#include "framework/mesh/ring.hpp"
#include "framework/types.hpp"

namespace sprekk {

struct RegionDrawing {
  struct Line {
    std::array<int, 2> points;
    bool is_boundary;  ///< with the region on one side, or else inside of it
    bool is_whole;     ///< stays one edge
  };
  std::vector<Point> points;  ///< multiples of 2^-32 between -1 and 1, as those of CanonicalDrawing
  std::vector<Line> lines;    ///< have no points in common but their ends
};

struct RegionMesh {
  std::vector<Point> points;              ///< those of the drawing first
  std::vector<Ring> triangles;            ///< counter-clockwise
  std::vector<std::vector<int>> on_line;  ///< points along each line, its ends included
  int first_inside;                       ///< number of the first point that is on no line
};

/// Divides the lines, makes a Delaunay triangulation that has their edges, and adds points from the lines inward, where
/// they make nearly equilateral triangles with edges that are there (Rebay, J. Comput. Phys. 106 (1993) 125), until
/// circumradii fit to `size`, the wanted length of edges at a place. It should grow by no more than half of the
/// distance. The same drawing makes the same mesh. Throws std::runtime_error when lines have more than ends in common,
/// or when boundaries are not closed.
RegionMesh mesh_region(const RegionDrawing& drawing, const std::function<double(const Point&)>& size);

}  // namespace sprekk
