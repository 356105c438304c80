#include "framework/remeshing/overlap.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>

#include "framework/mesh/adjacency.hpp"
#include "framework/mesh/plane/planar.hpp"

namespace sprekk {
namespace {

struct Extent {
  Point low = Point::Constant(std::numeric_limits<double>::infinity());
  Point high = -low;

  Extent() = default;
  explicit Extent(const Corners& corners) {
    for (const Point& x : corners) add(x);
  }
  void add(const Point& x) {
    low = low.cwiseMin(x);
    high = high.cwiseMax(x);
  }
  bool meets(const Extent& other) const {
    return (low.array() <= other.high.array()).all() && (other.low.array() <= high.array()).all();
  }
};

/// Each half plane adds at most one corner; rounding may add two more to thin polygons.
constexpr int most_corners = 4 + 4 + 2;

/// A convex polygon, counter-clockwise.
struct Polygon {
  std::array<Point, most_corners> corners;
  int count = 0;

  /// The part to the left of the line from p to q (Sutherland-Hodgman).
  Polygon left_of(const Point& p, const Point& q) const {
    Polygon part;
    for (int i = 0; i < count; ++i) {
      const Point &a = corners[i], &b = corners[(i + 1) % count];
      const double at_a = cross(q - p, a - p), at_b = cross(q - p, b - p);
      if (at_a >= 0) part.corners[part.count++] = a;
      if ((at_a > 0 && at_b < 0) || (at_a < 0 && at_b > 0)) {
        part.corners[part.count++] = a + at_a / (at_a - at_b) * (b - a);
      }
      if (part.count + 2 > most_corners) break;
    }
    return part;
  }

  double area() const {
    double twice = 0;
    for (int i = 1; i + 1 < count; ++i) twice += cross(corners[i] - corners[0], corners[i + 1] - corners[0]);
    return 0.5 * twice;
  }

  Point centre() const {
    double twice = 0;
    Point moment = Point::Zero();
    for (int i = 1; i + 1 < count; ++i) {
      const Point one = corners[i] - corners[0], other = corners[i + 1] - corners[0];
      twice += cross(one, other);
      moment += cross(one, other) * (one + other) / 3;
    }
    return twice > 0 ? Point(corners[0] + moment / twice) : corners[0];
  }
};

/// Relative to the first corner of a, so that coordinates far from the origin cost no digits.
Polygon common_polygon(const Corners& a, const Corners& b) {
  const Point origin = a[0];
  Polygon part;
  for (const Point& x : b) part.corners[part.count++] = x - origin;
  for (int k = 0; k < a.size() && part.count > 0; ++k) part = part.left_of(a[k] - origin, a.after(k) - origin);
  return part;
}

/// A grid of buckets, each with the cells whose bounding boxes meet the bucket.
class Buckets {
 public:
  explicit Buckets(const std::vector<Corners>& cells) {
    Extent whole;
    for (const Corners& corners : cells) {
      for (const Point& x : corners) whole.add(x);
    }
    low_ = whole.low;
    const Point size = whole.high - whole.low;
    width_ = std::sqrt(size.x() * size.y() / static_cast<double>(cells.size()));
    for (int axis = 0; axis < 2; ++axis) counts_[axis] = 1 + static_cast<int>(size[axis] / width_);
    cells_.offsets.assign(static_cast<std::size_t>(counts_[0]) * counts_[1] + 1, 0);
    for (const Corners& corners : cells) {
      for_each(Extent(corners), [&](int b) { ++cells_.offsets[b + 1]; });
    }
    std::partial_sum(cells_.offsets.begin(), cells_.offsets.end(), cells_.offsets.begin());
    cells_.items.resize(cells_.offsets.back());
    auto next = cells_.offsets;
    for (std::size_t c = 0; c < cells.size(); ++c) {
      for_each(Extent(cells[c]), [&](int b) { cells_.items[next[b]++] = static_cast<int>(c); });
    }
  }

  /// Finds the cells in the buckets of `extent`, ascending, each once.
  void find(const Extent& extent, std::vector<int>& found) const {
    found.clear();
    for_each(extent, [&](int b) { found.insert(found.end(), cells_[b].begin(), cells_[b].end()); });
    std::sort(found.begin(), found.end());
    found.erase(std::unique(found.begin(), found.end()), found.end());
  }

 private:
  int bucket(int axis, double coordinate) const {
    return static_cast<int>(std::clamp((coordinate - low_[axis]) / width_, 0.0, counts_[axis] - 1.0));
  }
  template <class Visit>
  void for_each(const Extent& extent, const Visit& visit) const {
    for (int j = bucket(1, extent.low.y()); j <= bucket(1, extent.high.y()); ++j) {
      for (int i = bucket(0, extent.low.x()); i <= bucket(0, extent.high.x()); ++i) visit(j * counts_[0] + i);
    }
  }

  Point low_;
  double width_;
  std::array<int, 2> counts_;
  Adjacency cells_;
};

}  // namespace

double common_area(const Corners& a, const Corners& b) {
  const Polygon part = common_polygon(a, b);
  return part.count < 3 ? 0 : part.area();
}

CommonPart common_part(const Corners& a, const Corners& b) {
  CommonPart common;
  Polygon part;
  if (Extent(a).meets(Extent(b))) part = common_polygon(a, b);
  if (part.count >= 3) common.area = part.area();
  if (!(common.area > 0)) {
    common.area = 0;
    part.count = a.size();
    for (int k = 0; k < a.size(); ++k) part.corners[k] = a[k] - a[0];
  }
  common.centre = a[0] + part.centre();
  return common;
}

void for_each_overlap(const std::vector<Corners>& one, const std::vector<Corners>& other,
                      const std::function<void(int, int, double)>& visit) {
  if (one.empty() || other.empty()) return;
  const Buckets buckets(other);
  std::vector<int> found;
  for (std::size_t i = 0; i < one.size(); ++i) {
    const Extent extent(one[i]);
    buckets.find(extent, found);
    for (const int j : found) {
      if (!extent.meets(Extent(other[j]))) continue;
      const double area = common_area(one[i], other[j]);
      if (area > 0) visit(static_cast<int>(i), j, area);
    }
  }
}

}  // namespace sprekk
