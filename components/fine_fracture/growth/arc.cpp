#include "components/fine_fracture/growth/arc.hpp"

#include <algorithm>
#include <cmath>

#include "framework/invariants.hpp"
#include "framework/mesh/plane/planar.hpp"

namespace sprekk::fine_fracture {
namespace {

constexpr double half_of_largest_turn = 0.4;  ///< rad, between an arc and its chord

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

PlaceOnPath place_on_segment(const Point& anchor, const std::optional<Point>& start, const Point& end, double length) {
  if (start) return place_on_arc(anchor, *start, end, length);
  const Point ahead = (end - anchor).normalized();
  return {anchor + length * ahead, ahead};
}

Point corner_of_arc(const Point& anchor, const Point& start, const Point& end) {
  const Point chord = end - anchor;
  SPREKK_EXPECT(chord.norm() > 0, chord.norm());
  return end - (1 - place_of_corner) * turned(chord, -turn_at_start(chord, start));
}

}  // namespace sprekk::fine_fracture
