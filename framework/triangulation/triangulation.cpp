#include "framework/triangulation/triangulation.hpp"

#include <algorithm>
#include <limits>
#include <numbers>

#include "framework/mesh/face_table.hpp"
#include "framework/mesh/plane/planar.hpp"

namespace sprekk {
namespace {

constexpr double worthwhile = 1e-3;  ///< rad; changes that gain less are not made
constexpr double acceptable =
    20 * std::numbers::pi / 180;  ///< the least angle after a flip that removes a corner with two barriers
constexpr int most_rounds = 12;   // improvements end before

/// A round of changes on fixed connections. Triangles that a change has touched are stale until the next round.
class Round {
 public:
  explicit Round(Triangulation& t)
      : t_(t),
        edges_(t.points, std::vector<Ring>(t.triangles.begin(), t.triangles.end())),
        is_fixed_(edges_.size()),
        is_barrier_(edges_.size()) {
    for (const auto& [points, is_barrier] : t.fixed_edges) {
      const int edge = edges_.find({points[0], points[1]});
      if (edge < 0) continue;
      is_fixed_[edge] = true;
      if (is_barrier) is_barrier_[edge] = true;
    }
  }

  /// Flips edges where that raises the smaller of the two triangles' smallest angles.
  bool flip() {
    std::vector<bool> is_stale(t_.triangles.size());
    bool changed = false;
    for (int edge = 0; edge < edges_.size(); ++edge) {
      if (is_fixed_[edge] || edges_.is_outer(edge)) continue;
      const auto [one, other] = edges_.cells(edge);
      if (is_stale[one] || is_stale[other]) continue;
      const auto [a, c] = edges_.nodes(edge);
      const int b = opposite(other, a, c), d = opposite(one, a, c);  // a, b, c, d is counter-clockwise
      if (makes_corner(a, b, d) || makes_corner(c, b, d)) continue;
      const double now = std::min(angle(a, b, c), angle(c, d, a));
      const double then = std::min(angle(a, b, d), angle(b, c, d));
      const bool cures_corner = barriers(one) > 1 || barriers(other) > 1;
      if (then < (cures_corner ? acceptable : now + worthwhile)) continue;
      t_.triangles[one] = {a, b, d};
      t_.triangles[other] = {b, c, d};
      is_stale[one] = is_stale[other] = changed = true;
    }
    return changed;
  }

  /// Moves each free point to the best of some places.
  bool move() {
    std::vector<std::vector<int>> around(t_.points.size());
    for (std::size_t i = 0; i < t_.triangles.size(); ++i) {
      for (const int point : t_.triangles[i]) {
        if (!t_.is_fixed[point]) around[point].push_back(static_cast<int>(i));
      }
    }
    bool changed = false;
    for (std::size_t point = 0; point < t_.points.size(); ++point) {
      if (!around[point].empty() && move(static_cast<int>(point), around[point])) changed = true;
    }
    return changed;
  }

  /// Halves the third edge of triangles with two barriers.
  bool divide_corners() {
    std::vector<bool> is_stale(t_.triangles.size());
    bool changed = false;
    const int count = static_cast<int>(t_.triangles.size());
    for (int triangle = 0; triangle < count; ++triangle) {
      if (barriers(triangle) != 2 || is_stale[triangle]) continue;
      for (int k = 0; k < 3; ++k) {
        const int edge = edges_.of_cell(triangle)[k];
        if (is_barrier_[edge] || edges_.is_outer(edge)) continue;
        const auto [one, other] = edges_.cells(edge);
        const int neighbour = one == triangle ? other : one;
        if (is_stale[neighbour]) continue;
        halve(triangle, neighbour, t_.triangles[triangle][k], t_.triangles[triangle][(k + 1) % 3]);
        is_stale[triangle] = is_stale[neighbour] = changed = true;
      }
    }
    return changed;
  }

  int barriers(int triangle) const {
    int count = 0;
    for (const int edge : edges_.of_cell(triangle)) count += is_barrier_[edge] ? 1 : 0;
    return count;
  }

 private:
  int opposite(int triangle, int p, int q) const {
    for (const int point : t_.triangles[triangle]) {
      if (point != p && point != q) return point;
    }
    return -1;
  }
  double angle(int a, int b, int c) const { return smallest_angle(t_.points[a], t_.points[b], t_.points[c]); }
  bool is_barrier(int a, int b) const {
    const int edge = edges_.find({a, b});
    return edge >= 0 && is_barrier_[edge];
  }
  /// Whether both edges at `corner` of a triangle are barriers, its third edge being new.
  bool makes_corner(int corner, int p, int q) const { return is_barrier(corner, p) && is_barrier(corner, q); }

  /// The smallest angle of all triangles, or the first angle found that is not above `enough`.
  double worst_around(const std::vector<int>& triangles, double enough) const {
    double worst = std::numeric_limits<double>::infinity();
    for (const int i : triangles) {
      worst = std::min(worst, angle(t_.triangles[i][0], t_.triangles[i][1], t_.triangles[i][2]));
      if (worst <= enough) break;
    }
    return worst;
  }

  bool move(int point, const std::vector<int>& triangles) {
    double best = worst_around(triangles, -std::numeric_limits<double>::infinity());
    // A point with good triangles around it stays.
    constexpr double good_enough = 50;  // degrees, of the 60 that are the most
    if (best > good_enough * std::numbers::pi / 180) return false;
    const Point start = t_.points[point];
    Point best_place = start, mean = Point::Zero();
    double reach = std::numeric_limits<double>::infinity();
    for (const int i : triangles) {
      for (const int other : t_.triangles[i]) {
        if (other == point) continue;
        mean += t_.points[other] / (2.0 * static_cast<double>(triangles.size()));
        reach = std::min(reach, (t_.points[other] - start).norm());
      }
    }
    const auto attempt = [&](const Point& place) {
      t_.points[point] = place;
      const double worst = worst_around(triangles, best);
      if (worst > best) best = worst, best_place = place;
    };
    const double before = best;
    attempt(mean);
    attempt(0.5 * (mean + start));
    constexpr double first = 0.25, last = 0.01;  // of the shortest edge there
    for (double step = first * reach; step > last * reach; step *= 0.5) {
      const Point center = best_place;
      const double h = std::numbers::sqrt2 / 2;
      for (const Point& way : {Point(1, 0), Point(h, h), Point(0, 1), Point(-h, h), Point(-1, 0), Point(-h, -h),
                               Point(0, -1), Point(h, -h)}) {
        attempt(center + step * way);
      }
    }
    const bool is_better = best > before + worthwhile;
    t_.points[point] = is_better ? best_place : start;
    return is_better;
  }

  /// The edge from a to b, counter-clockwise in `triangle`.
  void halve(int triangle, int neighbour, int a, int b) {
    const int middle = static_cast<int>(t_.points.size());
    t_.points.push_back(0.5 * (t_.points[a] + t_.points[b]));
    t_.is_fixed.push_back(false);
    for (std::size_t i = 0; i < t_.fixed_edges.size(); ++i) {
      auto& [points, is_barrier] = t_.fixed_edges[i];
      if (std::minmax(points[0], points[1]) != std::minmax(a, b)) continue;
      t_.is_fixed.back() = true;
      points = {a, middle};
      t_.fixed_edges.push_back({{middle, b}, false});
      break;
    }
    const int c = opposite(triangle, a, b), d = opposite(neighbour, a, b);
    t_.triangles[triangle] = {a, middle, c};
    t_.triangles.push_back({middle, b, c});
    t_.triangles[neighbour] = {middle, a, d};
    t_.triangles.push_back({b, middle, d});
  }

  Triangulation& t_;
  const FaceTable edges_;
  std::vector<bool> is_fixed_, is_barrier_;
};

}  // namespace

double smallest_angle(const Triangulation& triangulation) {
  double smallest = std::numeric_limits<double>::infinity();
  for (const auto& [a, b, c] : triangulation.triangles) {
    smallest =
        std::min(smallest, smallest_angle(triangulation.points[a], triangulation.points[b], triangulation.points[c]));
  }
  return smallest;
}

int single_corner_count(const Triangulation& triangulation) {
  Triangulation copy = triangulation;
  const Round round(copy);
  int count = 0;
  for (int i = 0; i < static_cast<int>(copy.triangles.size()); ++i) count += round.barriers(i) > 1 ? 1 : 0;
  return count;
}

void improve(Triangulation& triangulation) {
  const auto raise_angles = [&] {
    for (int i = 0; i < most_rounds; ++i) {
      const bool flipped = Round(triangulation).flip();
      const bool moved = Round(triangulation).move();
      if (!flipped && !moved) break;
    }
  };
  raise_angles();
  if (Round(triangulation).divide_corners()) raise_angles();
}

}  // namespace sprekk
