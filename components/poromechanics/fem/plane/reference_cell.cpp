#include "components/poromechanics/fem/reference_cell.hpp"

#include <array>

#include "components/poromechanics/fem/gauss_points.hpp"
#include "framework/invariants.hpp"

namespace sprekk::poromechanics {

namespace {

using Functions = std::vector<ReferenceFunction>;

/// On the unit triangle.
Functions triangle_functions(double xi, double eta) {
  const ReferenceFunction corner[3] = {{1 - xi - eta, {-1, -1}}, {xi, {1, 0}}, {eta, {0, 1}}};
  Functions functions(corner, corner + 3);
  for (int k = 0; k < 3; ++k) functions.push_back(4 * (corner[k] * corner[(k + 1) % 3]));
  functions.push_back(27 * (corner[0] * corner[1] * corner[2]));
  return functions;
}

/// On the unit square, whose corners are (0, 0), (1, 0), (1, 1), (0, 1).
Functions square_functions(double xi, double eta) {
  const ReferenceFunction low[2] = {{1 - xi, {-1, 0}}, {1 - eta, {0, -1}}}, high[2] = {{xi, {1, 0}}, {eta, {0, 1}}};
  const ReferenceFunction bump[2] = {4 * (low[0] * high[0]), 4 * (low[1] * high[1])};
  return {low[0] * low[1],   high[0] * low[1],  high[0] * high[1], low[0] * high[1], bump[0] * low[1],
          high[0] * bump[1], bump[0] * high[1], low[0] * bump[1],  bump[0] * bump[1]};
}

std::vector<ReferencePoint> points_of(bool is_triangle, int start) {
  std::vector<ReferencePoint> points;
  for (const GaussPoint& first : gauss_points())
    for (const GaussPoint& second : gauss_points()) {
      // A triangle is a square of which one side has no length.
      const double shrink = is_triangle ? 1 - first.at : 1;
      double share[3];
      share[start % 3] = first.at;
      share[(start + 1) % 3] = shrink * second.at;
      share[(start + 2) % 3] = shrink * (1 - second.at);
      points.push_back({first.weight * second.weight * shrink,
                        is_triangle ? triangle_functions(share[1], share[2]) : square_functions(first.at, second.at)});
    }
  return points;
}

}  // namespace

const std::vector<ReferencePoint>& reference_points(int corners, int start, bool /*has_edges*/) {
  SPREKK_EXPECT((corners == 3 || corners == 4) && is_index(start, corners), corners, start);
  static const std::array triangle{points_of(true, 0), points_of(true, 1), points_of(true, 2)};
  static const std::vector<ReferencePoint> square = points_of(false, 0);
  return corners == 3 ? triangle[start] : square;
}

}  // namespace sprekk::poromechanics
