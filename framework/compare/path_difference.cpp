#include "framework/compare/path_difference.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>

#include "framework/round_off.hpp"

namespace sprekk {
namespace {

// Distances are measured at the corners of a line and between them: a segment's farthest point is a corner, or a point
// that is equally near to two segments of the other line.
constexpr int points_between = 7;

double apart(const Position& a, const Position& b) { return std::hypot(a[0] - b[0], a[1] - b[1]); }

/// The nearest place of a line.
struct Nearest {
  double distance = std::numeric_limits<double>::infinity();
  bool is_end = false;
};

/// How many segments end at each place; one at the ends of the line.
std::map<Position, int> joined(const Polyline& line) {
  std::map<Position, int> count;
  for (const auto& segment : line.segments)
    for (const Position& end : segment) ++count[end];
  return count;
}

Nearest nearest(const Position& place, const Polyline& line, const std::map<Position, int>& count) {
  Nearest best;
  for (const auto& [a, b] : line.segments) {
    const double x = b[0] - a[0], y = b[1] - a[1], square = x * x + y * y;
    const double along = square > 0 ? ((place[0] - a[0]) * x + (place[1] - a[1]) * y) / square : 0;
    const double share = std::clamp(along, 0.0, 1.0);
    const double distance = apart(place, {a[0] + share * x, a[1] + share * y});
    if (!(distance < best.distance)) continue;
    const bool is_beyond_end =
        (along <= rounding::same && count.at(a) == 1) || (along >= 1 - rounding::same && count.at(b) == 1);
    best = {distance, is_beyond_end};
  }
  return best;
}

/// Distances from the points of one line to the other one.
struct OneWay {
  double largest = 0, sideways = 0;
  Position where{};
};

OneWay one_way(const Polyline& from, const Polyline& to) {
  OneWay result;
  const std::map<Position, int> count = joined(to);
  for (const auto& [a, b] : from.segments)
    for (int k = 0; k <= points_between + 1; ++k) {
      const double share = static_cast<double>(k) / (points_between + 1);
      const Position place = {a[0] + share * (b[0] - a[0]), a[1] + share * (b[1] - a[1])};
      const Nearest found = nearest(place, to, count);
      if (!found.is_end) result.sideways = std::max(result.sideways, found.distance);
      if (!(found.distance > result.largest)) continue;
      result.largest = found.distance;
      result.where = place;
    }
  return result;
}

}  // namespace

double Polyline::length() const {
  double sum = 0;
  for (const auto& [a, b] : segments) sum += apart(a, b);
  return sum;
}

std::vector<Polyline> polylines(const Grid& fractures, const Grid& paths) {
  std::vector<Polyline> lines;
  for (const Grid* grid : {&fractures, &paths}) {
    const Grid::Values* const number = grid->find("fracture");
    for (std::size_t i = 0; number != nullptr && i < number->values.size(); ++i) {
      const auto fracture = static_cast<std::size_t>(number->values[i]);
      if (fracture >= lines.size()) lines.resize(fracture + 1);
      const auto end = [&](std::size_t k) { return grid->points[static_cast<std::size_t>(grid->cells[2 * i + k])]; };
      if (apart(end(0), end(1)) > 0) lines[fracture].segments.push_back({end(0), end(1)});
    }
  }
  return lines;
}

PathDifference path_difference(const Polyline& one, const Polyline& other) {
  const OneWay there = one_way(one, other), back = one_way(other, one);
  PathDifference difference;
  difference.scale = std::max(one.length(), other.length());
  const auto rounded = [&](double distance) {
    return std::abs(distance) > rounding::of_terms * difference.scale ? distance : 0;
  };
  difference.there = rounded(there.largest);
  difference.back = rounded(back.largest);
  difference.sideways = rounded(std::max(there.sideways, back.sideways));
  difference.length = rounded(one.length() - other.length());
  difference.where = there.largest >= back.largest ? there.where : back.where;
  return difference;
}

}  // namespace sprekk
