// The place of a point of a wall on its segment, and integration along walls.
#pragma once

#include <algorithm>
#include <cmath>

#include "components/fine_fracture/fine_level/quadrature.hpp"
#include "components/fine_fracture/quarter_point/mesh/fine_mesh.hpp"
#include "framework/mesh/mesh.hpp"

namespace sprekk::fine_fracture {

/// A place on a segment of a crack.
struct WallPlace {
  int segment;
  double s;  ///< 0 to 1 along the segment
};

/// The place of a point x of an edge. An edge may lie on several segments of a straight part. At a point where two
/// segments meet, the result is on the segment that is nearer to the middle of the edge.
inline WallPlace wall_place(const FineMesh& mesh, const FineMesh::WallEdge& edge, const Point& x) {
  const std::vector<double>& lengths = mesh.arc_lengths[edge.crack];
  const Point& from = mesh.nodes[edge.nodes[0][0]];
  const double arc = edge.from + std::clamp((x - from).dot(edge.tangent), 0.0, edge.to - edge.from);
  // An end of the edge must not fall into the next segment: it is moved a little towards the middle.
  constexpr double rounding = 1e-9;  // of the way to the middle: round-off of lengths
  const double inside = arc + rounding * (0.5 * (edge.from + edge.to) - arc);
  const int last = static_cast<int>(lengths.size()) - 2;
  const auto above = std::upper_bound(lengths.begin(), lengths.end(), inside);
  const int segment = std::clamp(static_cast<int>(above - lengths.begin()) - 1, 0, last);
  return {segment, std::clamp((arc - lengths[segment]) / (lengths[segment + 1] - lengths[segment]), 0.0, 1.0)};
}

/// Gauss rules, with `points` each, for the parts of an edge that lie on different segments: loads may jump there.
inline std::vector<LinePoint> wall_rule(const FineMesh& mesh, const FineMesh::WallEdge& edge, int points) {
  const double length = edge.to - edge.from;
  // In a rosette the distance from the tip is proportional to the square of the parameter.
  const bool has_tip_first = edge.tip != none && edge.nodes[0][0] == mesh.tips[edge.tip].node;
  const auto parameter = [&](double part) {
    if (edge.tip == none) return part;
    return has_tip_first ? std::sqrt(part) : 1 - std::sqrt(1 - part);
  };
  std::vector<double> stops{0};
  constexpr double smallest_part = 1e-6;  // of the edge: a shorter piece is round-off of lengths
  for (const double arc : mesh.arc_lengths[edge.crack]) {
    const double part = (arc - edge.from) / length;
    if (part > smallest_part && part < 1 - smallest_part) stops.push_back(parameter(part));
  }
  stops.push_back(1);
  std::vector<LinePoint> rule;
  for (std::size_t i = 0; i + 1 < stops.size(); ++i) {
    const double width = stops[i + 1] - stops[i];
    for (const LinePoint& place : line_rule(points)) rule.push_back({stops[i] + width * place.t, width * place.weight});
  }
  return rule;
}

}  // namespace sprekk::fine_fracture
