// Rounds the input of a mesh generator, so that inputs that differ by round-off give the same mesh.
#pragma once

#include <array>
#include <cmath>
#include <vector>

#include "framework/mesh/plane/planar.hpp"
#include "framework/types.hpp"

namespace sprekk {

/// A mesh generator compares and counts, and where two lengths are equal except for their last digits, round-off
/// decides which topology the mesh gets. So a mesh is made for a drawing on a coarse grid, and its nodes are moved to
/// the given drawing afterwards: its topology changes where a number crosses a border between two multiples of the grid
/// only, and its nodes are continuous in between.

/// `value` on a grid of the given spacing. Borders lie at an irrational part of the spacing: round numbers are no ties.
double rounded(double value, double spacing);

/// A positive number with `steps` values between one power of two and the next.
double rounded_in_octave(double value, int steps);

/// A frame that follows a drawing: shifted, scaled by a power of two, and turned by half a turn or not. Drawings that
/// are images of one another under a shift or half a turn, with their anchors, are the same in it.
struct DrawingFrame {
  Point origin = Point::Zero();  ///< m
  double scale = 1;              ///< m, negative for half a turn

  Point inward(const Point& x) const { return (x - origin) / scale; }
  Point outward(const Point& x) const { return origin + scale * x; }
  double unit() const { return std::abs(scale); }  ///< m
};

/// The frame of a drawing of the extent (m), with the anchor as its origin. The lines decide about the half turn.
DrawingFrame drawing_frame(double extent, const std::vector<Segment>& lines, const Point& anchor);

/// The points of a drawing on grids of their own. The spacing at a point is a power of two, by the local length: the
/// least of `largest` and the distances between the point, or a line that ends there, and what it does not touch. A
/// point moves by less than a twentieth of this length. Lines meet in their ends only.
std::vector<Point> rounded_points(const std::vector<Point>& points, const std::vector<std::array<int, 2>>& lines,
                                  double largest);

}  // namespace sprekk
