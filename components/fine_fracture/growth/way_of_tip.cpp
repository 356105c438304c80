#include "components/fine_fracture/growth/way_of_tip.hpp"

#include <algorithm>
#include <cmath>

#include "framework/invariants.hpp"

namespace sprekk::fine_fracture {

Point place_on_way(const Point& anchor, const std::vector<Point>& way, double length) {
  SPREKK_EXPECT(!way.empty() && length > 0, way.size(), length);
  const auto next =
      std::find_if(way.begin(), way.end() - 1, [&](const Point& x) { return (x - anchor).norm() >= length; });
  const Point to = *next - anchor;
  const double far = to.norm();
  SPREKK_EXPECT(far > 0, far);
  double turn = 0;  // from `to`, so that nothing depends on where angles begin
  if (next != way.begin()) {
    const Point from = *(next - 1) - anchor;
    const double near = from.norm();
    if (near < far)
      turn = std::atan2(to[0] * from[1] - to[1] * from[0], to.dot(from)) * std::max(0.0, far - length) / (far - near);
  }
  const Point direction = to / far;
  return anchor + length * Point(std::cos(turn) * direction[0] - std::sin(turn) * direction[1],
                                 std::sin(turn) * direction[0] + std::cos(turn) * direction[1]);
}

}  // namespace sprekk::fine_fracture
