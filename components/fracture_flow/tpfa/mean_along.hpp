// Means of a datum along pieces of fractures.
#pragma once

#include <array>
#include <cmath>
#include <vector>

#include "framework/assembly/property.hpp"
#include "framework/mesh/mesh.hpp"

namespace sprekk::fracture_flow {

/// A straight piece of a fracture, in rock of one region. Indices as in Place.
struct Piece {
  Point from, to;  ///< m
  int region = 0, fracture = 0;
  std::vector<Point> corners = {};  ///< m, in their order around the piece, whose middle is `from`; none for a line
};

/// The cells of the fractures, and the lines in them from their centres to the middles of FractureCell::ridges[place]:
/// in a plane half cells. Cells with fewer ridges have a line that is not used.
std::vector<Piece> whole_cells(const Mesh& mesh);
std::vector<Piece> parts_of_cells(const Mesh& mesh, int place);
/// The largest number of ridges that a fracture cell has.
int most_ridges(const Mesh& mesh);

/// How values along a piece are averaged.
enum class Mean {
  of_values,      ///< arithmetic: for conductors in parallel
  of_reciprocals  ///< harmonic, 1 over the mean of 1 over the values: for conductors in series
};

/// The mean of a datum on each piece, evaluated for a step (value_in_step). A datum that does not depend on the
/// position is evaluated once for each piece; a datum that does not depend on time is evaluated only once.
class MeansAlong {
 public:
  /// An empty object, to be assigned to.
  MeansAlong() = default;
  /// Evaluates the datum at `start` (s). Throws DataError.
  MeansAlong(const Data& data, std::vector<Piece> pieces, Mean mean, double start);

  /// Evaluates the datum for this step. Throws DataError.
  void evaluate(const StepTime& step);
  double operator[](int i) const { return values_[i]; }

 private:
  template <typename At>
  void set(const At& at);

  Data data_;
  std::vector<Piece> pieces_;
  Mean mean_ = Mean::of_values;
  Vector values_;
};

/// Points in (-1, 1) and their weights, which add up to 1: Gauss' rule with 10 points for u, where x = (3 u - u^3) / 2.
/// Near the ends 1 - |x| is of the order of (1 - |u|)^2, so that roots of it become smooth.
struct EndRule {
  static constexpr int count = 10;
  std::array<double, count> x, weight;
};
const EndRule& end_rule();  ///< computed at the first call

/// The mean over a piece with corners: exact for polynomials of second order (the middles of the edges of each
/// triangle).
template <typename Function>
double mean_within(const Piece& piece, const Function& value) {
  double sum = 0, area = 0;
  for (std::size_t k = 0; k < piece.corners.size(); ++k) {
    const Point &a = piece.from, &b = piece.corners[k], &c = piece.corners[(k + 1) % piece.corners.size()];
    const Point u = b - a, v = c - a;
    const double part = std::sqrt(u.squaredNorm() * v.squaredNorm() - u.dot(v) * u.dot(v)) / 2;
    sum += part / 3 * (value(Point((a + b) / 2)) + value(Point((b + c) / 2)) + value(Point((c + a) / 2)));
    area += part;
  }
  return sum / area;
}

/// The mean over the piece: along a line exact for polynomials of fifth order, and to 1e-7 for a root or an inverse
/// root of the distance from one or both ends. The ends themselves are not evaluated.
template <typename Function>
double mean_along(const Piece& piece, const Function& value) {
  if (!piece.corners.empty()) return mean_within(piece, value);
  const EndRule& rule = end_rule();
  double sum = 0;
  for (int i = 0; i < EndRule::count; ++i)
    sum += rule.weight[i] * value(Point(0.5 * (1 - rule.x[i]) * piece.from + 0.5 * (1 + rule.x[i]) * piece.to));
  return sum;
}

}  // namespace sprekk::fracture_flow
