#include "components/fine_fracture/tips/beside_arcs.hpp"

#include <cmath>

#include "components/fine_fracture/fine_level/outline.hpp"
#include "framework/invariants.hpp"
#include "framework/round_off.hpp"

namespace sprekk::fine_fracture {

namespace {

constexpr double reach_over_height = 4;  ///< distances of places change by a third at most

}  // namespace

void BesideArcs::add(const Point& from, const Point& middle, const Point& to) {
  const double length = (to - from).norm();
  SPREKK_EXPECT(length > 0, length);
  const Point along = (to - from) / length, normal(-along.y(), along.x());
  const double place = along.dot(middle - from), height = normal.dot(middle - from);
  if (height == 0 || place <= 0 || place >= length) return;
  arcs_.push_back({from, along, normal, length, place, height, reach_over_height * std::abs(height)});
}

Point BesideArcs::moved(const Arc& arc, const Point& x) {
  const double place = arc.along.dot(x - arc.from), across = arc.normal.dot(x - arc.from);
  if (place <= 0 || place >= arc.length || std::abs(across) >= arc.reach) return x;
  const double part = place < arc.middle ? place / arc.middle : (arc.length - place) / (arc.length - arc.middle);
  const double height = part * arc.height;
  if (std::abs(across - height) <= rounding::same * arc.length) return x;
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
