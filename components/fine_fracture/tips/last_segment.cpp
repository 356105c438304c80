// The last segment of a path, while the mesh follows its tip: where it is divided.
#include <algorithm>
#include <cmath>

#include "components/fine_fracture/tips/tips_front.hpp"
#include "framework/mesh/plane/planar.hpp"

namespace sprekk::fine_fracture {

namespace {

constexpr double full_segment = 1;        ///< of an increment: a longer segment is divided
constexpr double rest_of_segment = 0.5;   ///< of an increment, or of a shorter segment: what may still turn
constexpr double longest_segment = 1.5;   ///< of an increment: a longer one is divided in a short step, too
constexpr double turn_of_segment = 0.06;  ///< rad: one that turns further is divided when it is shorter
constexpr double least_full = 0.4;        ///< of the length of a straight segment that is divided
constexpr double least_advance = 0.05;    ///< of an increment: a step in which a tip advances by less divides nothing

}  // namespace

/// The length at which the last segment is divided, over that of a straight one: an arc stands for a path that is
/// hardly bent. Beside a kink the path turns by up to 0.15 rad over an increment, and where an arc of this form was
/// divided K changed by 1.5 %.
double TipsFront::part_by_turn(const Tips::Tip& tip) const {
  if (!tip.now.segment_start) return 1;
  const Point end = tips_.end_direction(tip);
  const double turn = std::abs(std::atan2(cross(*tip.now.segment_start, end), tip.now.segment_start->dot(end)));
  return turn > turn_of_segment ? std::max(least_full, turn_of_segment / turn) : 1;
}

/// The length of the last segment that is fixed from now on, m.
double TipsFront::what_stays(const Tips::Tip& tip, const FrontTip& start) const {
  const double increment = tips_.options_.growth.increment;
  if (!tip.now.was_laid) return 0;
  // A step in which the tip hardly advances keeps its cells: dividing one would change K by more than the advance does.
  const bool is_short = start.speed > 0 && start.speed * dt_ < least_advance * increment;
  if (is_short && start.covered < longest_segment * increment) return 0;
  const double full = full_segment * increment * part_by_turn(tip);
  return start.covered > full ? start.covered - rest_of_segment * std::min(start.covered, increment) : 0;
}

}  // namespace sprekk::fine_fracture
