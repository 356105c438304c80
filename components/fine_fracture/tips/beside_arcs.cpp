#include "components/fine_fracture/tips/beside_arcs.hpp"

#include <algorithm>
#include <cmath>
#include <functional>

#include "components/fine_fracture/fine_level/outline.hpp"
#include "framework/invariants.hpp"

namespace sprekk::fine_fracture {

namespace {

constexpr double reach_over_height = 4;  ///< distances of places change by a third at most
constexpr double on_the_arc = 1e-9;      ///< of the chord

}  // namespace

void BesideArcs::add(const std::vector<Point>& points) {
  const Point from = points.front(), chord = points.back() - from;
  const double length = chord.norm();
  SPREKK_EXPECT(length > 0, length);
  const Point along = chord / length, normal(-along.y(), along.x());
  Arc arc{from, along, normal, {0}, {0}, 0};
  for (std::size_t i = 1; i + 1 < points.size(); ++i) {
    arc.places.push_back(along.dot(points[i] - from));
    arc.heights.push_back(normal.dot(points[i] - from));
    arc.reach = std::max(arc.reach, reach_over_height * std::abs(arc.heights.back()));
  }
  arc.places.push_back(length);
  arc.heights.push_back(0);
  if (arc.reach > 0 && std::ranges::adjacent_find(arc.places, std::greater_equal()) == arc.places.end())
    arcs_.push_back(arc);
}

Point BesideArcs::moved(const Arc& arc, const Point& x) {
  const double place = arc.along.dot(x - arc.from), across = arc.normal.dot(x - arc.from), length = arc.places.back();
  if (place <= 0 || place >= length || std::abs(across) >= arc.reach) return x;
  const std::size_t next = std::ranges::upper_bound(arc.places, place) - arc.places.begin();
  const double part = (place - arc.places[next - 1]) / (arc.places[next] - arc.places[next - 1]);
  const double height = std::lerp(arc.heights[next - 1], arc.heights[next], part);
  if (std::abs(across - height) <= on_the_arc * length) return x;
  const double room = across > height ? arc.reach - height : arc.reach + height;
  return x + ((across - height) * arc.reach / room - across) * arc.normal;
}

std::vector<Point> BesideArcs::on_coarse_level(std::vector<Point> places, const std::vector<Point>& outline) const {
  for (const Arc& arc : arcs_)
    for (Point& place : places)
      if (const Point there = moved(arc, place); there != place && depth_inside(there, outline) >= 0) place = there;
  return places;
}

}  // namespace sprekk::fine_fracture
