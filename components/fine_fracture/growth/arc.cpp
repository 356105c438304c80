#include "components/fine_fracture/growth/arc.hpp"

#include <algorithm>
#include <cmath>

#include "framework/invariants.hpp"
#include "framework/mesh/planar.hpp"

namespace sprekk::fine_fracture {
namespace {

constexpr double half_of_largest_turn = 0.4;  ///< rad, between an arc and its chord
constexpr int pieces_of_arc = 3;

/// From one direction to the other: nothing depends on where angles begin.
double turn_between(const Point& from, const Point& to) { return std::atan2(cross(from, to), from.dot(to)); }

Point turned(const Point& direction, double by) {
  return {std::cos(by) * direction[0] - std::sin(by) * direction[1],
          std::sin(by) * direction[0] + std::cos(by) * direction[1]};
}

/// rad, from the chord of an arc to its direction at the start.
double turn_at_start(const Point& chord, const Point& start) {
  return std::clamp(turn_between(chord, start), -half_of_largest_turn, half_of_largest_turn);
}

}  // namespace

PlaceOnPath place_on_arc(const Point& anchor, const Point& start, const Point& end, double length) {
  const Point chord = end - anchor;
  const double whole = chord.norm();
  SPREKK_EXPECT(length >= 0 && length <= whole, length, whole);
  const double turn = turn_at_start(chord, start), half = std::asin(length / whole * std::sin(turn));
  const Point direction = chord / whole;
  return {anchor + length * turned(direction, turn - half), turned(direction, turn - 2 * half)};
}

std::vector<Point> corners_of_arc(const Point& anchor, const Point& start, const Point& end) {
  const Point chord = end - anchor;
  const double whole = chord.norm();
  SPREKK_EXPECT(whole > 0, whole);
  const double turn = turn_at_start(chord, start), bend = 2 * turn / (pieces_of_arc - 1);
  const double half_of_piece =
      turn == 0 ? 0.5 * whole / (pieces_of_arc - 1) : 0.5 * whole * std::tan(0.5 * bend) / std::sin(turn);
  std::vector<Point> corners;
  Point corner = anchor;
  for (int i = 0; i + 1 < pieces_of_arc; ++i) {
    corner += (i == 0 ? 1 : 2) * half_of_piece * turned(chord / whole, turn - i * bend);
    corners.push_back(corner);
  }
  return corners;
}

}  // namespace sprekk::fine_fracture
