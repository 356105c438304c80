// A Delaunay triangulation to which points are added, with edges that stay.
#pragma once

#include <array>
#include <optional>
#include <vector>

#include "framework/types.hpp"

namespace sprekk {

/// Of points whose coordinates are multiples of 2^-32 between -2 and 2: whether three of them turn left is then decided
/// without rounding. Four points, numbers 0 to 3, are corners of a square far outside of all others. Points are added
/// by dividing the triangle where they lie, and edges flipped until no circumcircle has a corner of a neighbour in it
/// (Lawson 1977); fixed edges are recovered by flips (Sloan 1993), and are not flipped any more.
class Delaunay {
 public:
  static constexpr double grid = 0x1p-32;
  static constexpr int outer_points = 4;
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

  /// Adds a point that no fixed edge is near of; near it are triangles that have been changed last. Returns its number.
  /// Throws std::runtime_error when there is such a point already.
  int add(const Point& x);
  /// Makes an edge between two points. Throws std::runtime_error when another point or a fixed edge is in its way.
  void fix(int from, int to, Edge kind);
  /// Flips what is not Delaunay any more after edges have been fixed.
  void restore();

  /// The triangle where x lies, on a straight way from the middle of an edge of a triangle; none if a fixed edge is in
  /// the way or the point lies on an edge.
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
  /// Behind an edge that has a triangle there: the corner that is not on the edge.
  int point_behind(int triangle, int edge) const;
  void set_across(int triangle, int old_neighbour, int neighbour);
  bool can_flip(int triangle, int edge) const;
  void flip(int triangle, int edge);
  bool is_delaunay(int triangle, int edge) const;
  /// The edge from one point to another, or where the way from one to the other leaves the first triangle.
  std::optional<Place> edge_between(int from, int to) const;
  std::optional<Place> first_crossed(int from, int to) const;
  template <class Visit>
  void around(int point, const Visit& visit) const;

  std::vector<Point> points_;
  std::vector<Triangle> triangles_;
  std::vector<int> triangle_at_;  ///< one of those that have a point
  std::vector<int> changed_;
  int last_ = 0;
};

}  // namespace sprekk
