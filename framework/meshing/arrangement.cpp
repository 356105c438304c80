#include "framework/meshing/arrangement.hpp"

#include <algorithm>

namespace sprekk {

Arrangement arrange(const std::vector<Segment>& segments, double tolerance) {
  Arrangement arrangement;
  auto& points = arrangement.points;
  const auto number = [&](const Point& x) {
    for (std::size_t i = 0; i < points.size(); ++i) {
      if ((points[i] - x).norm() < tolerance) return static_cast<int>(i);
    }
    points.push_back(x);
    return static_cast<int>(points.size()) - 1;
  };
  for (const Segment& segment : segments) {
    const int from = number(segment.from);
    arrangement.chains.push_back({from, number(segment.to)});
  }
  for (std::size_t i = 0; i < segments.size(); ++i) {
    for (std::size_t j = 0; j < i; ++j) {
      Point crossing;
      if (cross_inside(segments[i], segments[j], crossing)) number(crossing);
    }
  }
  for (std::size_t i = 0; i < segments.size(); ++i) {
    auto& chain = arrangement.chains[i];
    const Point from = segments[i].from, along = segments[i].to - from;
    const int first = chain[0], last = chain[1];
    for (int p = 0; p < static_cast<int>(points.size()); ++p) {
      if (p != first && p != last && distance(points[p], segments[i]) < tolerance) chain.push_back(p);
    }
    std::sort(chain.begin(), chain.end(),
              [&](int a, int b) { return (points[a] - from).dot(along) < (points[b] - from).dot(along); });
  }
  return arrangement;
}

}  // namespace sprekk
