// Where flat fractures, of which one is an ellipse at least, nearly touch or overlap.
#pragma once

#include <optional>

#include "framework/meshing/space/flat_shape.hpp"
#include "framework/meshing/space/rim.hpp"

namespace sprekk {

/// A polygon, or the ellipse in the place of its polygon.
struct FlatFracture {
  const FlatShape& polygon;
  std::optional<Rim> rim = {};
};

/// A place (m) where two fractures are near to each other.
struct RimGap {
  Point at;
  double width;  ///< m
};

/// A gap wider than `tolerance` and narrower than `reach` between rims, edges, corners and insides, if there is one.
std::optional<RimGap> find_gap(const FlatFracture& one, const FlatFracture& other, double tolerance, double reach);

/// A place that both cover by more than `tolerance`, of fractures in one plane.
std::optional<Point> find_overlap(const FlatFracture& one, const FlatFracture& other, double tolerance);

}  // namespace sprekk
