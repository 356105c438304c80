#include "framework/meshing/plane/graded_division.hpp"

#include <algorithm>
#include <cmath>

namespace sprekk {

std::vector<Point> graded_division(const Segment& segment, const std::function<double(const Point&)>& size) {
  // The number of edges between the beginning of the segment and each sample, by the midpoint rule.
  constexpr int samples = 64;
  const Point along = segment.to - segment.from;
  double edges[samples + 1] = {0};
  for (int i = 0; i < samples; ++i) {
    const double wanted = size(segment.from + (i + 0.5) / samples * along);
    edges[i + 1] = edges[i] + along.norm() / samples / wanted;
  }
  const int count = std::max(1, static_cast<int>(std::lround(edges[samples])));
  std::vector<Point> points;
  for (int k = 1, i = 0; k < count; ++k) {
    const double at = edges[samples] * k / count;
    while (edges[i + 1] < at) ++i;
    points.push_back(segment.from + (i + (at - edges[i]) / (edges[i + 1] - edges[i])) / samples * along);
  }
  return points;
}

}  // namespace sprekk
