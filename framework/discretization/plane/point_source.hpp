// The cells around a point that a source at the point is spread over.
#pragma once

#include <functional>
#include <utility>
#include <vector>

#include "framework/mesh/mesh.hpp"

namespace sprekk {

/// A source at a point, as cells have it: sum of weight · rate enters each of them, and sum of weight · value is the
/// value of the cells at the point.
struct PointSource {
  Point at = Point::Zero();                    ///< the mean of the centres with these weights, m
  std::vector<std::pair<int, double>> shares;  ///< cells and weights, which are not negative and add up to 1
};

/// Spreads a source over the cells whose centres surround x, with the weights of a mean of their centres that is x: so
/// the total and the place of the source are kept, and fields that are linear between the centres have their value at
/// x. At the centre of a cell this is the cell alone. The cells are those around a node, and the weights mean value
/// coordinates (Floater, Computer Aided Geometric Design 20 (2003) 19), all of them positive. Beyond the last centres
/// before a side, a fracture, or cells that may not take part, x counts as the nearest point on the lines between the
/// centres of neighbours. A field is not known there, and extending it in a straight line would give negative weights:
/// a source would draw from cells, and a value could lie outside of all around it. Without shares outside of the mesh.
/// The cell at x may take part in any case.
PointSource point_source(const Mesh& mesh, const Point& x, const std::function<bool(int cell)>& may_share);

}  // namespace sprekk
