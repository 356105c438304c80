#include "framework/triangulation/mesh_region.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <queue>
#include <stdexcept>

#include "framework/mesh/mesh.hpp"
#include "framework/triangulation/delaunay.hpp"

namespace sprekk {
namespace {

Point onto_grid(const Point& x) {
  return {std::round(x.x() / Delaunay::grid) * Delaunay::grid, std::round(x.y() / Delaunay::grid) * Delaunay::grid};
}

/// Places that divide a line into edges of the wanted lengths.
std::vector<Point> division(const Point& from, const Point& to, const std::function<double(const Point&)>& size) {
  const double length = (to - from).norm();
  const Point along = (to - from) / length;
  // Steps are small, since sizes may differ by orders of magnitude. `edges`: the number of edges from the beginning to
  // each place.
  constexpr double step_per_size = 0.25;
  constexpr double smallest_step = 1e-9;  // of the line: a billion edges
  constexpr double nearly_all = 0.999;    // of what is left: the rest would be a step of rounding
  std::vector<double> places{0}, edges{0};
  while (places.back() < length) {
    const double left = length - places.back();
    double step = step_per_size * size(from + places.back() * along);
    if (!(step > smallest_step * length))
      throw std::runtime_error("the size wanted along a line is not positive, or a billionth of it");
    if (step > nearly_all * left) step = left;
    edges.push_back(edges.back() + step / size(from + (places.back() + 0.5 * step) * along));
    places.push_back(step == left ? length : places.back() + step);
  }
  constexpr double hardly_more = 0.01;  // an edge that is a hundredth longer is no reason for one more
  const int count = std::max(1, static_cast<int>(std::ceil(edges.back() - hardly_more)));
  std::vector<Point> points;
  std::size_t i = 0;
  for (int k = 1; k < count; ++k) {
    const double wanted = edges.back() * k / count;
    while (edges[i + 1] < wanted) ++i;
    const double part = (wanted - edges[i]) / (edges[i + 1] - edges[i]);
    points.push_back(onto_grid(from + (places[i] + part * (places[i + 1] - places[i])) * along));
  }
  return points;
}

class Mesher {
 public:
  Mesher(const RegionDrawing& drawing, const std::function<double(const Point&)>& size) : size_(size) {
    for (const Point& x : drawing.points) add(x);
    std::vector<std::vector<int>> on_line;
    for (const RegionDrawing::Line& line : drawing.lines) {
      std::vector<int>& points = mesh_.on_line.emplace_back();
      points.push_back(line.points[0]);
      if (!line.is_whole)
        for (const Point& x : division(drawing.points[line.points[0]], drawing.points[line.points[1]], size))
          points.push_back(add(x));
      points.push_back(line.points[1]);
    }
    mesh_.first_inside = static_cast<int>(sizes_.size());
    for (std::size_t l = 0; l < drawing.lines.size(); ++l) {
      const std::vector<int>& points = mesh_.on_line[l];
      for (std::size_t i = 0; i + 1 < points.size(); ++i)
        delaunay_.fix(points[i] + Delaunay::outer_points, points[i + 1] + Delaunay::outer_points,
                      drawing.lines[l].is_boundary ? Delaunay::Edge::boundary : Delaunay::Edge::line);
    }
    delaunay_.restore();
    respect_short_edges();
    find_inside();
    fill();
  }

  RegionMesh take() {
    mesh_.points.assign(delaunay_.points().begin() + Delaunay::outer_points, delaunay_.points().end());
    for (int t = 0; t < count(); ++t) {
      if (states_[t].state == State::outside) continue;
      const auto [a, b, c] = delaunay_.triangles()[t].corners;
      mesh_.triangles.emplace_back(a - Delaunay::outer_points, b - Delaunay::outer_points, c - Delaunay::outer_points);
    }
    return std::move(mesh_);
  }

 private:
  static constexpr double growth = 0.4;  ///< of sizes away from short edges, per distance
  enum class State { outside, done, large };
  struct Entry {
    double excess;
    int triangle, version;
    bool operator<(const Entry& other) const {
      return std::pair(excess, -triangle) < std::pair(other.excess, -other.triangle);
    }
  };
  struct Kept {
    State state = State::outside;
    int version = 0;
    double excess = 0;  ///< circumradius over that of an equilateral triangle of the wanted size
  };

  int count() const { return static_cast<int>(delaunay_.triangles().size()); }
  const Point& point(int number) const { return delaunay_.points()[number]; }
  double size_at(int number) const { return sizes_[number - Delaunay::outer_points]; }

  int add(const Point& x) {
    delaunay_.add(x);
    sizes_.push_back(size_(x));
    return static_cast<int>(sizes_.size()) - 1;
  }

  /// Lines may be shorter than the wanted size at their ends. Sizes then grow from the lengths of the given edges.
  void respect_short_edges() {
    constexpr double most = 1.5;  // times the length of an edge: divided lines have edges shorter than wanted
    for (const std::vector<int>& points : mesh_.on_line) {
      for (std::size_t i = 0; i + 1 < points.size(); ++i) {
        const double length =
            (point(points[i] + Delaunay::outer_points) - point(points[i + 1] + Delaunay::outer_points)).norm();
        for (const int end : {points[i], points[i + 1]}) sizes_[end] = std::min(sizes_[end], most * length);
      }
    }
  }

  /// Starts at the outer points; each boundary edge separates the outside from the inside.
  void find_inside() {
    states_.assign(count(), {});
    std::vector<char> is_reached(count(), false);
    const auto& triangles = delaunay_.triangles();
    const auto first = std::find_if(triangles.begin(), triangles.end(), [](const Delaunay::Triangle& t) {
      return *std::min_element(t.corners.begin(), t.corners.end()) < Delaunay::outer_points;
    });
    std::vector<int> reached{static_cast<int>(first - triangles.begin())};
    is_reached[reached[0]] = true;
    for (std::size_t i = 0; i < reached.size(); ++i) {
      const Delaunay::Triangle& t = triangles[reached[i]];
      for (int k = 0; k < 3; ++k) {
        const int other = t.across[k];
        if (other == none || is_reached[other]) continue;
        const bool is_outside = states_[reached[i]].state == State::outside;
        const bool changes = t.edges[k] == Delaunay::Edge::boundary;
        states_[other].state = is_outside == changes ? State::large : State::outside;
        is_reached[other] = true;
        reached.push_back(other);
      }
    }
    require_closed_boundary();
    for (int t = 0; t < count(); ++t)
      if (states_[t].state != State::outside) rate(t);
  }

  void require_closed_boundary() const {
    const auto is_outside = [this](int t) { return t == none || states_[t].state == State::outside; };
    for (int t = 0; t < count(); ++t) {
      const Delaunay::Triangle& triangle = delaunay_.triangles()[t];
      for (int k = 0; k < 3; ++k) {
        const bool separates = is_outside(t) != is_outside(triangle.across[k]);
        if (separates != (triangle.edges[k] == Delaunay::Edge::boundary))
          throw std::runtime_error("the boundary of a region is not closed");
      }
    }
  }

  struct Circle {
    Point center;
    double radius;
  };
  Circle circumcircle(int t) const {
    const auto& corners = delaunay_.triangles()[t].corners;
    const Point &a = point(corners[0]), p = point(corners[1]) - a, q = point(corners[2]) - a;
    const double twice = 2 * (p.x() * q.y() - p.y() * q.x()), p2 = p.squaredNorm(), q2 = q.squaredNorm();
    const Point to_center((q.y() * p2 - p.y() * q2) / twice, (p.x() * q2 - q.x() * p2) / twice);
    return {a + to_center, to_center.norm()};
  }

  void rate(int t) {
    Kept& kept = states_[t];
    ++kept.version;
    const auto& corners = delaunay_.triangles()[t].corners;
    const double size = (size_at(corners[0]) + size_at(corners[1]) + size_at(corners[2])) / 3;
    kept.excess = std::numbers::sqrt3 * circumcircle(t).radius / size;
    // The geometric mean of the excess of a triangle that fits and of one that should be divided.
    constexpr double most = 1.2247;
    kept.state = kept.excess > most ? State::large : State::done;
    if (kept.state == State::large) queue_.push({kept.excess, t, kept.version});
  }

  bool is_front(int t, int k) const {
    const Delaunay::Triangle& triangle = delaunay_.triangles()[t];
    return triangle.edges[k] != Delaunay::Edge::free || states_[triangle.across[k]].state == State::done;
  }

  /// Puts large triangles beside a finished one into the queue.
  void requeue_neighbours(int t) {
    const Delaunay::Triangle& triangle = delaunay_.triangles()[t];
    for (int k = 0; k < 3; ++k) {
      if (triangle.edges[k] != Delaunay::Edge::free) continue;
      const Kept& other = states_[triangle.across[k]];
      if (other.state == State::large) queue_.push({other.excess, triangle.across[k], other.version});
    }
  }

  void fill() {
    constexpr std::size_t most_points = 2'000'000;  // no memory holds more
    while (!queue_.empty()) {
      const Entry entry = queue_.top();
      queue_.pop();
      const Kept& kept = states_[entry.triangle];
      if (kept.state != State::large || kept.version != entry.version) continue;
      const int front = shortest_front(entry.triangle);
      if (front == none) continue;  // the triangle waits until a neighbour is finished
      if (!divide(entry.triangle, front)) {
        states_[entry.triangle].state = State::done;  // cannot be improved
        requeue_neighbours(entry.triangle);
      }
      if (sizes_.size() > most_points) throw std::runtime_error("the wanted sizes make more than two million points");
    }
  }

  int shortest_front(int t) const {
    const auto& corners = delaunay_.triangles()[t].corners;
    int best = none;
    double shortest = 0;
    for (int k = 0; k < 3; ++k) {
      const double length = (point(corners[(k + 1) % 3]) - point(corners[k])).norm();
      if (!is_front(t, k) || (best != none && length >= shortest)) continue;
      best = k;
      shortest = length;
    }
    return best;
  }

  /// Adds a point over the middle of an edge: at the height of an equilateral triangle, or lower, so that the
  /// circumradius does not exceed the wanted one.
  bool divide(int t, int k) {
    const auto& corners = delaunay_.triangles()[t].corners;
    const Point &a = point(corners[k]), &b = point(corners[(k + 1) % 3]);
    const Point middle = 0.5 * (a + b);
    const double half = 0.5 * (b - a).norm();
    const Point inward = Point(a.y() - b.y(), b.x() - a.x()) / (2 * half);
    const double q = (circumcircle(t).center - middle).dot(inward);
    if (q <= 0) return false;
    const double size = 0.5 * (size_at(corners[k]) + size_at(corners[(k + 1) % 3]));
    const double radius = std::min(std::max(size / std::numbers::sqrt3, half), (half * half + q * q) / (2 * q));
    const double height = radius + std::sqrt(std::max(0.0, radius * radius - half * half));
    const Point x = onto_grid(middle + height * inward);
    const int place = delaunay_.straight_to(t, k, x);
    if (place == none || states_[place].state == State::outside) return false;
    double wanted = size_(x);
    for (const int corner : delaunay_.triangles()[place].corners)
      wanted = std::min(wanted, size_at(corner) + growth * (x - point(corner)).norm());
    if (is_crowded(place, x, wanted)) return false;
    sizes_.push_back(wanted);
    delaunay_.add_inside(place, x);
    states_.resize(count(), {State::large});
    const std::vector<int> changed = delaunay_.changed();
    for (const int i : changed) rate(i);
    for (const int i : changed)
      if (states_[i].state == State::done) requeue_neighbours(i);
    return true;
  }

  /// Whether a place is too near to a corner or a fixed edge of the triangle that contains it.
  bool is_crowded(int t, const Point& x, double size) const {
    constexpr double to_corners = 0.5, to_lines = 0.3;  // of the wanted edge
    const Delaunay::Triangle& triangle = delaunay_.triangles()[t];
    for (int k = 0; k < 3; ++k) {
      const Point &a = point(triangle.corners[k]), &b = point(triangle.corners[(k + 1) % 3]);
      if ((x - a).norm() < to_corners * size) return true;
      const Point along = b - a, way = x - a;
      const double height = (along.x() * way.y() - along.y() * way.x()) / along.norm();
      if (triangle.edges[k] != Delaunay::Edge::free && height < to_lines * std::min(size, along.norm())) return true;
    }
    return false;
  }

  const std::function<double(const Point&)>& size_;
  Delaunay delaunay_;
  std::vector<double> sizes_;  ///< by point, without the outer ones
  std::vector<Kept> states_;   ///< by triangle
  std::priority_queue<Entry> queue_;
  RegionMesh mesh_;
};

}  // namespace

RegionMesh mesh_region(const RegionDrawing& drawing, const std::function<double(const Point&)>& size) {
  return Mesher(drawing, size).take();
}

}  // namespace sprekk
