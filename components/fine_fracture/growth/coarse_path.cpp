#include "components/fine_fracture/growth/coarse_path.hpp"

#include <algorithm>

#include "framework/invariants.hpp"

namespace sprekk::fine_fracture {

namespace {

constexpr double shortest_edge = 0.5;     ///< of the coarse size: as in the paper
constexpr double shortest_at_bend = 0.1;  ///< of the coarse size
constexpr double sharp_bend = 0.02;       ///< of the length of the path: what is lost without a bend

}  // namespace

std::vector<Point> coarse_path(const Point& start, const std::vector<Point>& added, double coarse_size,
                               SharpBends bends) {
  SPREKK_EXPECT(!added.empty() && coarse_size > 0, added.size(), coarse_size);
  double length = 0;
  for (std::size_t i = 0; i < added.size(); ++i) length += (added[i] - (i == 0 ? start : added[i - 1])).norm();
  const auto is_sharp = [&](const Point& before, const Point& at, const Point& after) {
    const double to = (at - before).norm(), on = (after - at).norm();
    return bends == SharpBends::stay && std::min(to, on) >= shortest_at_bend * coarse_size &&
           to + on - (after - before).norm() > sharp_bend * length;
  };
  const auto is_short = [&](const Point& from, const Point& to) {
    return (to - from).norm() < shortest_edge * coarse_size;
  };
  const Point& end = added.back();
  std::vector<Point> points{start};
  for (std::size_t i = 0; i + 1 < added.size(); ++i)
    if (!is_short(points.back(), added[i]) || is_sharp(points.back(), added[i], added[i + 1]))
      points.push_back(added[i]);
  if (points.size() > 1 && is_short(points.back(), end) && !is_sharp(points[points.size() - 2], points.back(), end))
    points.pop_back();
  points.push_back(end);
  points.erase(points.begin());
  return points;
}

}  // namespace sprekk::fine_fracture
