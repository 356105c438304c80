// A field within cells, as linear functions on parts of them.
#pragma once

#include <array>
#include <map>
#include <vector>

#include "framework/types.hpp"

namespace sprekk {

/// A linear function on a triangle that is a part of a cell.
struct LinearPiece {
  std::array<Point, 3> corners;  ///< counter-clockwise, m
  std::array<double, 3> values;  ///< at the corners
  /// How much it counts, 0 to 1, against a linear function in the whole cell.
  double weight = 1;

  /// The value at x, which lies in the triangle.
  double at(const Point& x) const;
};

/// By cell, the pieces that make up the cell. Their mean, with all weights 1, is that of the cell.
using LinearPieces = std::map<int, std::vector<LinearPiece>>;

}  // namespace sprekk
