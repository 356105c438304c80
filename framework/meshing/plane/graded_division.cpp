#include "framework/meshing/plane/graded_division.hpp"

#include <algorithm>
#include <cmath>

namespace sprekk {

std::vector<Point> graded_division(const Segment& segment, const std::function<double(const Point&)>& size) {
  // The number of edges between the beginning of the segment and each sample, by the midpoint rule.
  const Point along = segment.to - segment.from;
  double edges[samples_of_length + 1] = {0};
  for (int i = 0; i < samples_of_length; ++i) {
    const double wanted = size(segment.from + (i + 0.5) / samples_of_length * along);
    edges[i + 1] = edges[i] + along.norm() / samples_of_length / wanted;
  }
  const int count = std::max(1, static_cast<int>(std::lround(edges[samples_of_length])));
  std::vector<Point> points;
  for (int k = 1, i = 0; k < count; ++k) {
    const double at = edges[samples_of_length] * k / count;
    while (edges[i + 1] < at) ++i;
    points.push_back(segment.from + (i + (at - edges[i]) / (edges[i + 1] - edges[i])) / samples_of_length * along);
  }
  return points;
}

}  // namespace sprekk
