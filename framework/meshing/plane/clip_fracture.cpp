#include "framework/meshing/clip_fracture.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <optional>
#include <utility>

namespace sprekk {
namespace {

/// The part of a segment inside of a box, by the two shares of its length at which it begins and ends (Liang and Barsky
/// 1984); nothing where it lies outside or touches the box in a point.
std::optional<std::pair<double, double>> inside(const Point& from, const Point& to, const Box& box) {
  double first = 0, last = 1;
  for (int axis = 0; axis < dimension; ++axis) {
    const double step = to[axis] - from[axis], to_low = box.low[axis] - from[axis],
                 to_high = box.high[axis] - from[axis];
    if (step == 0) {
      if (to_low > 0 || to_high < 0) return std::nullopt;
      continue;
    }
    first = std::max(first, std::min(to_low / step, to_high / step));
    last = std::min(last, std::max(to_low / step, to_high / step));
  }
  if (!(first < last)) return std::nullopt;
  return std::pair(first, last);
}

/// A point at a share of a segment, exactly on a side where it is cut there.
Point at(const Point& from, const Point& to, double share, const Box& box) {
  if (share == 0) return from;
  if (share == 1) return to;
  const double tolerance = point_tolerance(box);
  Point point = from + share * (to - from);
  for (int axis = 0; axis < dimension; ++axis)
    for (const double side : {box.low[axis], box.high[axis]})
      if (std::abs(point[axis] - side) < tolerance) point[axis] = side;
  return point;
}

bool is_along_a_side(const Point& a, const Point& b, const Box& box) {
  for (int axis = 0; axis < dimension; ++axis)
    for (const double side : {box.low[axis], box.high[axis]})
      if (std::max(std::abs(a[axis] - side), std::abs(b[axis] - side)) < point_tolerance(box)) return true;
  return false;
}

}  // namespace

std::vector<FractureGeometry> clipped(const FractureGeometry& fracture, const Box& box) {
  std::vector<std::vector<Point>> parts;
  bool goes_on = false;  // from the last point of the last part
  for (std::size_t i = 0; i + 1 < fracture.points.size(); ++i) {
    const Point &from = fracture.points[i], &to = fracture.points[i + 1];
    const auto part = inside(from, to, box);
    if (!part) {
      goes_on = false;
      continue;
    }
    const Point begin = at(from, to, part->first, box), end = at(from, to, part->second, box);
    if ((end - begin).norm() < point_tolerance(box) || is_along_a_side(begin, end, box)) {
      goes_on = false;
      continue;
    }
    if (!goes_on || part->first > 0) parts.push_back({begin});
    parts.back().push_back(end);
    goes_on = part->second == 1;
  }
  std::vector<FractureGeometry> result;
  for (std::vector<Point>& points : parts) {
    FractureGeometry each = fracture;
    if (parts.size() > 1) each.name = fmt::format("{}_{}", fracture.name, result.size() + 1);
    each.points = std::move(points);
    result.push_back(std::move(each));
  }
  return result;
}

}  // namespace sprekk
