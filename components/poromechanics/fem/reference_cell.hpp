// The functions of a cell on its reference shape.
#pragma once

#include <vector>

#include "framework/types.hpp"

namespace sprekk::poromechanics {

/// A function of the coordinates of a reference cell, with its derivatives.
struct ReferenceFunction {
  double value;
  Point slope;

  friend ReferenceFunction operator*(const ReferenceFunction& a, const ReferenceFunction& b) {
    return {a.value * b.value, a.value * b.slope + b.value * a.slope};
  }
  friend ReferenceFunction operator*(double factor, const ReferenceFunction& a) {
    return {factor * a.value, factor * a.slope};
  }
};

/// A point of the integrals over a reference cell, with the functions of CellPoint there.
struct ReferencePoint {
  double weight;  ///< all of them add up to the measure of the reference cell
  std::vector<ReferenceFunction> functions;
};

/// The points of the reference cell with so many corners. `start`: the corner of a triangle, or of that of a wedge,
/// from which the points lie along rays; of a tetrahedron, one bit for each corner from which, together, they do.
/// `has_edges`: whether there are functions of edges.
const std::vector<ReferencePoint>& reference_points(int corners, int start, bool has_edges);

}  // namespace sprekk::poromechanics
