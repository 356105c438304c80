// Where on its segment a point of a wall lies.
#pragma once

#include <algorithm>

#include "components/fine_fracture/quarter_point/fine_mesh.hpp"

namespace sprekk::fine_fracture {

struct WallPlace {
  int segment;
  double s;  ///< 0 to 1 along the segment
};

/// An edge may lie on several segments of a straight part. Where two segments meet, the one that the edge's middle is
/// nearer to answers.
inline WallPlace wall_place(const FineMesh& mesh, const FineMesh::WallEdge& edge, const Point& x) {
  const std::vector<double>& lengths = mesh.arc_lengths[edge.crack];
  const Point& from = mesh.nodes[edge.nodes[0][0]];
  const double arc = edge.from + std::clamp((x - from).dot(edge.tangent), 0.0, edge.to - edge.from);
  // A rounding's way towards the middle, so that an end of the edge does not fall into the next segment.
  const double inside = arc + 1e-9 * (0.5 * (edge.from + edge.to) - arc);
  const int last = static_cast<int>(lengths.size()) - 2;
  const auto above = std::upper_bound(lengths.begin(), lengths.end(), inside);
  const int segment = std::clamp(static_cast<int>(above - lengths.begin()) - 1, 0, last);
  return {segment, std::clamp((arc - lengths[segment]) / (lengths[segment + 1] - lengths[segment]), 0.0, 1.0)};
}

}  // namespace sprekk::fine_fracture
