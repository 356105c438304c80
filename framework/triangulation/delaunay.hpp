// A constrained Delaunay triangulation to which points are added.
#pragma once

#include <array>
#include <optional>
#include <vector>

#include "framework/types.hpp"

namespace sprekk {

/// A Delaunay triangulation with fixed edges. Coordinates are multiples of 2^-32 between -2 and 2: the orientation of
/// three points is then decided without rounding. Points 0 to 3 are corners of a square far outside of all others. A
/// new point divides the triangle in which it lies, and edges are flipped until no circumcircle contains a corner of a
/// neighbour (Lawson 1977). Fixed edges are recovered by flips (Sloan 1993), and are not flipped afterwards.
class Delaunay {
 public:
  static constexpr double grid = 0x1p-32;  ///< products of two coordinates fit into 128 bits
  static constexpr int outer_points = 4;
  /// Free edges may be flipped; lines inside of the region and edges of its boundary are fixed.
  enum class Edge : char { free, line, boundary };

  /// Edge k leads from corner k to the next one. Corners are counter-clockwise.
  struct Triangle {
    std::array<int, 3> corners;
    std::array<int, 3> across;  ///< the triangles behind the edges, or none
    std::array<Edge, 3> edges{};
  };

  Delaunay();

  const std::vector<Point>& points() const { return points_; }
  const std::vector<Triangle>& triangles() const { return triangles_; }

  /// Adds a point that is not near a fixed edge, and returns its number. The search for its triangle starts at the last
  /// change, so consecutive points should be near each other. Throws std::runtime_error when the point exists already.
  int add(const Point& x);
  /// Makes an edge between two points. Throws std::runtime_error when another point or a fixed edge is in its way.
  void fix(int from, int to, Edge kind);
  /// Flips edges that violate the Delaunay criterion after edges have been fixed.
  void restore();

  /// The triangle that contains x, found along the straight line from the middle of an edge of a triangle; none if a
  /// fixed edge crosses that line, or x lies on an edge.
  int straight_to(int triangle, int edge, const Point& x) const;
  /// Adds a point inside of a triangle. `changed()` then tells which triangles are new.
  int add_inside(int triangle, const Point& x);
  const std::vector<int>& changed() const { return changed_; }

 private:
  struct Place {
    int triangle;
    int edge;  ///< of a triangle, or none
  };
  int find(const Point& x) const;
  int corner_of(int triangle, int point) const;
  /// The corner, not on the edge, of the triangle across the edge, which must exist.
  int point_behind(int triangle, int edge) const;
  void set_across(int triangle, int old_neighbour, int neighbour);
  bool can_flip(int triangle, int edge) const;
  void flip(int triangle, int edge);
  bool is_delaunay(int triangle, int edge) const;
  /// The edge between two points, if it exists; and the edge through which the line between two points leaves the first
  /// triangle.
  std::optional<Place> edge_between(int from, int to) const;
  std::optional<Place> first_crossed(int from, int to) const;
  template <class Visit>
  void around(int point, const Visit& visit) const;

  std::vector<Point> points_;
  std::vector<Triangle> triangles_;
  std::vector<int> triangle_at_;  ///< per point: one of its triangles
  std::vector<int> changed_;
  int last_ = 0;
};

}  // namespace sprekk
