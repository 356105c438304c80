#include "framework/triangulation/delaunay.hpp"

#include <cmath>
#include <cstdint>
#include <deque>
#include <stdexcept>

#include "framework/invariants.hpp"
#include "framework/mesh/mesh.hpp"
#include "framework/mesh/plane/planar.hpp"

namespace sprekk {
namespace {

int next(int k) { return k == 2 ? 0 : k + 1; }
int previous(int k) { return k == 0 ? 2 : k - 1; }

/// The sign of the area of a, b, c, exactly. Differences of points on the grid have no rounding.
int turn(const Point& a, const Point& b, const Point& c) {
  const Point p = b - a, q = c - a;
  const double one = p.x() * q.y(), other = p.y() * q.x(), area = one - other;
  constexpr double rounding = 0x1p-51;  // some roundings of these products: below, the exact sign
  if (std::abs(area) > rounding * (std::abs(one) + std::abs(other))) return area > 0 ? 1 : -1;
  const auto whole = [](double x) { return static_cast<__int128>(static_cast<std::int64_t>(x / Delaunay::grid)); };
  const __int128 exact = whole(p.x()) * whole(q.y()) - whole(p.y()) * whole(q.x());
  return exact > 0 ? 1 : exact < 0 ? -1 : 0;
}

/// Whether d lies inside of the circle through a, b, c by more than rounding.
bool is_in_circle(const Point& a, const Point& b, const Point& c, const Point& d) {
  const Point p = a - d, q = b - d, r = c - d;
  const double p2 = p.squaredNorm(), q2 = q.squaredNorm(), r2 = r.squaredNorm();
  const double qr = cross(q, r), rp = cross(r, p), pq = cross(p, q);
  constexpr double rounding = 1e-14;  // some roundings of these products: what is nearer is on the circle
  const double sizes = p2 * q.norm() * r.norm() + q2 * r.norm() * p.norm() + r2 * p.norm() * q.norm();
  return p2 * qr + q2 * rp + r2 * pq > rounding * sizes;
}

}  // namespace

Delaunay::Delaunay()
    : points_{{-8, -8}, {8, -8}, {8, 8}, {-8, 8}},
      triangles_{{{0, 1, 2}, {none, none, 1}}, {{0, 2, 3}, {0, none, none}}},
      triangle_at_{0, 0, 0, 1} {}

int Delaunay::find(const Point& x) const {
  // Walks from triangle to triangle towards x. Without fixed edges no triangle is visited twice.
  int t = last_;
  constexpr std::size_t most_a_triangle = 4;  // fixed edges may lead around: a search needs a few
  for (std::size_t steps = 0; steps <= most_a_triangle * triangles_.size(); ++steps) {
    int towards = none;
    for (int k = 0; k < 3 && towards == none; ++k) {
      const auto& corners = triangles_[t].corners;
      if (turn(points_[corners[k]], points_[corners[next(k)]], x) < 0) towards = triangles_[t].across[k];
    }
    if (towards == none) return t;
    t = towards;
  }
  throw std::runtime_error("a point was not found in the triangulation");
}

int Delaunay::add(const Point& x) {
  const int triangle = find(x);
  for (const int corner : triangles_[triangle].corners)
    if (points_[corner] == x) throw std::runtime_error("two points of the drawing are the same");
  return add_inside(triangle, x);
}

void Delaunay::set_across(int triangle, int old_neighbour, int neighbour) {
  if (triangle == none) return;
  for (int& across : triangles_[triangle].across)
    if (across == old_neighbour) {
      across = neighbour;
      return;
    }
}

int Delaunay::add_inside(int triangle, const Point& x) {
  SPREKK_EXPECT(is_index(triangle, static_cast<long>(triangles_.size())), triangle);
  SPREKK_EXPECT(x.allFinite());
  const int point = static_cast<int>(points_.size());
  points_.push_back(x);
  const Triangle old = triangles_[triangle];
  const int count = static_cast<int>(triangles_.size());
  const std::array<int, 3> parts{triangle, count, count + 1};
  triangles_.resize(count + 2);
  for (int k = 0; k < 3; ++k) {
    triangles_[parts[k]] = {{old.corners[k], old.corners[next(k)], point},
                            {old.across[k], parts[next(k)], parts[previous(k)]},
                            {old.edges[k], Edge::free, Edge::free}};
    if (k > 0) set_across(old.across[k], triangle, parts[k]);
    triangle_at_[old.corners[k]] = parts[k];
  }
  triangle_at_.push_back(triangle);
  changed_.assign(parts.begin(), parts.end());
  // The changed triangles lie around the new point; edge 0 of each is opposite to the point.
  for (std::size_t i = 0; i < changed_.size(); ++i) {
    const int t = changed_[i];
    while (true) {
      const int k = next(corner_of(t, point));
      const int other = triangles_[t].across[k];
      const auto& [a, b, c] = triangles_[t].corners;
      // If the point lies on this edge, the edge is removed.
      const bool is_flat = turn(points_[a], points_[b], points_[c]) == 0;
      if (other == none || triangles_[t].edges[k] != Edge::free) break;
      if (!is_flat && is_delaunay(t, k)) break;
      if (!is_flat && !can_flip(t, k)) break;
      flip(t, k);
      changed_.push_back(other);
    }
  }
  last_ = triangle;
  return point;
}

int Delaunay::corner_of(int triangle, int point) const {
  SPREKK_EXPECT(is_index(triangle, static_cast<long>(triangles_.size())), triangle);
  const auto& corners = triangles_[triangle].corners;
  SPREKK_EXPECT(corners[0] == point || corners[1] == point || corners[2] == point, triangle, point);
  return corners[0] == point ? 0 : corners[1] == point ? 1 : 2;
}

int Delaunay::point_behind(int triangle, int edge) const {
  const int behind = triangles_[triangle].across[edge];
  SPREKK_ASSERT(behind != none, triangle, edge);
  return triangles_[behind].corners[next(corner_of(behind, triangles_[triangle].corners[edge]))];
}

bool Delaunay::is_delaunay(int triangle, int edge) const {
  const Triangle& t = triangles_[triangle];
  return !is_in_circle(points_[t.corners[0]], points_[t.corners[1]], points_[t.corners[2]],
                       points_[point_behind(triangle, edge)]);
}

bool Delaunay::can_flip(int triangle, int edge) const {
  const Triangle& t = triangles_[triangle];
  if (t.across[edge] == none || t.edges[edge] != Edge::free) return false;
  const Point &a = points_[t.corners[edge]], &b = points_[t.corners[next(edge)]],
              &p = points_[t.corners[previous(edge)]], &d = points_[point_behind(triangle, edge)];
  return turn(a, d, p) > 0 && turn(d, b, p) > 0;
}

/// From (a, b, p) and (b, a, d) to (a, d, p) and (d, b, p).
void Delaunay::flip(int triangle, int edge) {
  const Triangle t = triangles_[triangle];
  const int neighbour = t.across[edge];
  SPREKK_ASSERT(neighbour != none && t.edges[edge] == Edge::free, triangle, edge, neighbour);
  const Triangle u = triangles_[neighbour];
  const int j = corner_of(neighbour, t.corners[next(edge)]);
  const int a = t.corners[edge], b = t.corners[next(edge)], p = t.corners[previous(edge)], d = u.corners[previous(j)];
  triangles_[triangle] = {{a, d, p},
                          {u.across[next(j)], neighbour, t.across[previous(edge)]},
                          {u.edges[next(j)], Edge::free, t.edges[previous(edge)]}};
  triangles_[neighbour] = {{d, b, p},
                           {u.across[previous(j)], t.across[next(edge)], triangle},
                           {u.edges[previous(j)], t.edges[next(edge)], Edge::free}};
  set_across(u.across[next(j)], neighbour, triangle);
  set_across(t.across[next(edge)], triangle, neighbour);
  triangle_at_[a] = triangle_at_[d] = triangle_at_[p] = triangle;
  triangle_at_[b] = neighbour;
}

/// Calls visit(triangle, corner) counter-clockwise around an inner point until visit returns true.
template <class Visit>
void Delaunay::around(int point, const Visit& visit) const {
  const int first = triangle_at_[point];
  int t = first;
  do {
    const int k = corner_of(t, point);
    if (visit(t, k)) return;
    t = triangles_[t].across[previous(k)];
  } while (t != first && t != none);
}

std::optional<Delaunay::Place> Delaunay::edge_between(int from, int to) const {
  std::optional<Place> found;
  around(from, [&](int t, int k) {
    if (triangles_[t].corners[next(k)] != to) return false;
    found = {t, k};
    return true;
  });
  return found;
}

std::optional<Delaunay::Place> Delaunay::first_crossed(int from, int to) const {
  const Point &a = points_[from], &b = points_[to];
  std::optional<Place> found;
  around(from, [&](int t, int k) {
    const Point &right = points_[triangles_[t].corners[next(k)]], &left = points_[triangles_[t].corners[previous(k)]];
    if (turn(a, b, right) >= 0 || turn(a, b, left) <= 0) return false;
    found = {t, next(k)};
    return true;
  });
  return found;
}

void Delaunay::fix(int from, int to, Edge kind) {
  SPREKK_EXPECT(from != to, from, to);
  SPREKK_EXPECT(is_index(from, static_cast<long>(points_.size())) && is_index(to, static_cast<long>(points_.size())));
  constexpr const char* in_the_way = "a line of the drawing leads through a point or a line of it";
  std::deque<std::array<int, 2>> crossed;
  if (!edge_between(from, to)) {
    std::optional<Place> place = first_crossed(from, to);
    if (!place) throw std::runtime_error(in_the_way);
    auto [t, k] = *place;
    while (true) {
      const int right = triangles_[t].corners[k], left = triangles_[t].corners[next(k)];
      if (triangles_[t].edges[k] != Edge::free) throw std::runtime_error(in_the_way);
      crossed.push_back({right, left});
      const int behind = triangles_[t].across[k], opposite = triangles_[behind].corners[next(corner_of(behind, right))];
      if (opposite == to) break;
      const int side = turn(points_[from], points_[to], points_[opposite]);
      if (side == 0) throw std::runtime_error(in_the_way);
      t = behind;
      k = side < 0 ? corner_of(t, opposite) : corner_of(t, right);
    }
  }
  // One that is there needs a few flips for each edge in its way.
  constexpr std::size_t at_least = 1000, for_an_edge = 100;
  const std::size_t most_tries = at_least + for_an_edge * crossed.size();
  for (std::size_t tries = 0; !crossed.empty(); ++tries) {
    if (tries > most_tries) throw std::runtime_error(in_the_way);
    const auto [a, b] = crossed.front();
    crossed.pop_front();
    const std::optional<Place> place = edge_between(a, b);
    if (!place) continue;
    if (!can_flip(place->triangle, place->edge)) {
      crossed.push_back({a, b});
      continue;
    }
    flip(place->triangle, place->edge);
    // The new edge leads from d to p of flip().
    const auto& corners = triangles_[place->triangle].corners;
    const int d = corners[1], p = corners[2];
    if (d == from || d == to || p == from || p == to) continue;
    if (turn(points_[from], points_[to], points_[d]) * turn(points_[from], points_[to], points_[p]) < 0)
      crossed.push_back({d, p});
  }
  for (const auto& [a, b] : {std::array{from, to}, std::array{to, from}}) {
    const std::optional<Place> place = edge_between(a, b);
    if (!place) throw std::runtime_error(in_the_way);
    triangles_[place->triangle].edges[place->edge] = kind;
  }
}

void Delaunay::restore() {
  for (bool changed = true; changed;) {
    changed = false;
    for (int t = 0; t < static_cast<int>(triangles_.size()); ++t) {
      for (int k = 0; k < 3; ++k) {
        if (!can_flip(t, k) || is_delaunay(t, k)) continue;
        flip(t, k);
        changed = true;
      }
    }
  }
}

int Delaunay::straight_to(int triangle, int edge, const Point& x) const {
  const Point start =
      0.5 * (points_[triangles_[triangle].corners[edge]] + points_[triangles_[triangle].corners[next(edge)]]);
  int t = triangle, entry = edge;
  for (std::size_t steps = 0; steps <= triangles_.size(); ++steps) {
    const Triangle& here = triangles_[t];
    const int right = next(entry), left = previous(entry);  // edges, to both sides of the opposite corner
    const int beyond_right = turn(points_[here.corners[right]], points_[here.corners[left]], x);
    const int beyond_left = turn(points_[here.corners[left]], points_[here.corners[entry]], x);
    if (beyond_right > 0 && beyond_left > 0) return t;
    if (beyond_right == 0 || beyond_left == 0) return none;
    int out = beyond_right < 0 ? right : left;
    if (beyond_right < 0 && beyond_left < 0)
      out = cross(x - start, points_[here.corners[left]] - start) > 0 ? right : left;
    if (here.edges[out] != Edge::free || here.across[out] == none) return none;
    const int behind = here.across[out];
    entry = corner_of(behind, here.corners[next(out)]);
    t = behind;
  }
  return none;
}

}  // namespace sprekk
