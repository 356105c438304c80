// Joins lines that nearly touch, so that they share places or keep apart.
#pragma once

#include <vector>

#include "framework/mesh/plane/planar.hpp"
#include "framework/meshing/geometry.hpp"

namespace sprekk {

/// A line to be joined with others.
struct LineToJoin {
  std::vector<Point> points;  ///< m
  bool is_closed = false;     ///< the last point is joined with the first; it may touch the sides of the box anywhere
};

/// A line afterwards: the places along it, also those where others meet it.
struct JoinedLine {
  std::vector<int> places;
  std::vector<int> points;  ///< per place the point of the given line that is there, or none
};

/// All lines afterwards, and the places that they share.
struct JoinedLines {
  std::vector<Point> places;    ///< m
  std::vector<char> has_moved;  ///< per place: whether points have moved there
  std::vector<JoinedLine> lines;
};

/// Moves points by about `reach` (m) at most, until every two places, and every place and every line that does not pass
/// through it, are `reach` apart. A point is moved to the nearest line, points that are near to one another to their
/// mean, and so are crossings. The nearest come first, so that the result depends on distances and not on the order of
/// the lines. Points nearer than `same` (m) are one place and do not move. Ends move onto sides of the box, other
/// points of open lines do not. Throws InputError if no end is found.
JoinedLines join_lines(const Box& box, const std::vector<LineToJoin>& lines, double reach, double same);

}  // namespace sprekk
