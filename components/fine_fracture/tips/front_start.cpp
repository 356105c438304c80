// The state of the tips with which the search for a front begins, and the speeds that it expects.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "components/fine_fracture/growth/front_limits.hpp"
#include "components/fine_fracture/tips/ends.hpp"
#include "components/fine_fracture/tips/tips_front.hpp"
#include "framework/mesh/plane/planar.hpp"

namespace sprekk::fine_fracture {

namespace {

/// Of an increment, in one step: fixed segments are longer than half an increment.
constexpr double longest_advance = 1.5;
constexpr double least_room = 0.01;  ///< of an increment: where less is free ahead, there is an obstacle
/// Of a change between the last two steps: it has noise, too; by the paper's section 5.2.
constexpr double carried_on = 0.5;
constexpr double largest_trend = 2;  ///< of the speed in this step over that in the last one

/// Speeds are means over the last two steps, because advances alternate: segments are divided every other step.
double mean_of_steps(double last, double before) { return last != 0 && before != 0 ? (last + before) / 2 : last; }

/// rad/m, of a path that turned by these in the last two steps: as in the last one, with half of the change from the
/// step before. A straight path turns to and fro by the error of the mesh, and goes on with the mean.
double next_turning(double last, double before) {
  return last * before > 0 ? last + carried_on * (last - before) : mean_of_steps(last, before);
}

double angle_between(const Point& from, const Point& to) { return std::atan2(cross(from, to), from.dot(to)); }

/// m, of the cells that have grown behind a kink at this end, or of the whole fracture where there is none. K of a wing
/// falls with its own length, while the fracture behind it stays as it is (Horii and Nemat-Nasser 1986).
double length_that_counts(const Mesh& mesh, const TipEnd& end) {
  const Fracture& fracture = mesh.fractures[end.fracture];
  const auto cell_at = [&](int k) -> const FractureCell& {
    return mesh.fracture_cells[fracture.first_cell + (end.at_end ? fracture.cell_count - 1 - k : k)];
  };
  const auto direction = [&](const FractureCell& cell) {
    return Point(mesh.ridges[cell.ridges[1]].center - mesh.ridges[cell.ridges[0]].center);
  };
  double grown = 0;
  for (int k = 0; k < fracture.cell_count && cell_at(k).grown; ++k) {
    grown += cell_at(k).measure;
    if (k + 1 < fracture.cell_count && !cell_at(k + 1).grown &&
        std::abs(angle_between(direction(cell_at(k)), direction(cell_at(k + 1)))) > least_kink)
      return grown;
  }
  return fracture_length(mesh, end.fracture);
}

}  // namespace

/// Turns the mean speeds of the tips over the last two steps into those that are expected of this one. The shares of
/// the tips alternate with the division of segments; their sum hardly does. It is taken to go on as it changed from one
/// step to the next.
void TipsFront::expect_speeds() {
  const auto has_trend = [](const auto& now) {
    return now.speed > 0 && now.speed_before > 0 && now.lasted > 0 && now.lasted_before > 0;
  };
  double last = 0, before = 0, part = 0;
  for (const Tips::Tip& tip : tips_.tips_) {
    if (!has_trend(tip.now)) continue;
    last += tip.now.speed;
    before += tip.now.speed_before;
    part = carried_on * std::min(1.0, (dt_ + tip.now.lasted) / (tip.now.lasted + tip.now.lasted_before));
  }
  if (last == 0) return;
  const double trend = std::clamp(std::pow(last / before, part), 1 / largest_trend, largest_trend),
               last_over_mean = last / (0.5 * (last + before));
  for (std::size_t i = 0; i < at_start_.size(); ++i)
    at_start_[i].speed *= trend * (has_trend(tips_.tips_[i].now) ? last_over_mean : 1);
}

void TipsFront::add(Tips::Tip& tip) {
  tip.pattern.reset();
  tip.next_start.reset();
  const double increment = tips_.options_.growth.increment;
  const Point end = tips_.position(tip, {});
  const Point ahead = tip.now.is_extendable ? tips_.direction(tip) : tips_.end_direction(tip);
  FrontTip start;
  Segment segment;
  start.anchor = end;
  start.angle = start.ahead = angle_of(ahead);
  start.toughness = tips_.toughness(tip);
  start.size = length_that_counts(tips_.mesh_, tip.end);
  start.speed = mean_of_steps(tip.now.speed, tip.now.speed_before);
  start.turning = next_turning(tip.now.turning, tip.now.turning_before);
  start.goes_on = goes_on_ && tip.now.is_extendable && !tip.now.is_stopped && tip.now.speed > 0;
  if (tip.now.is_extendable) {
    start.covered = tips_.last_cell(tip.end).measure;
    segment.replaced = 1;
    start.anchor = end - start.covered * ahead;
    tip.next_start = tip.now.segment_start;
    if (const double stays = what_stays(tip, start); stays > 0) {
      // What goes on is an arc of the same curvature; what stays becomes straight.
      const PlaceOnPath place = place_on_segment(start.anchor, tip.now.segment_start, end, stays);
      start.anchor = place.position;
      start.covered = (end - start.anchor).norm();
      start.angle = angle_of(end - start.anchor);
      segment.before.push_back(start.anchor);
      tip.next_start = place.direction;
    } else if (!tip.next_start && tip.now.was_laid) {
      // The first segment behind a kink was straight when the mesh began to follow it; from then on it is an arc.
      tip.next_start = ahead;
    }
    start.is_bent = tip.next_start.has_value();
    start.start = tip.next_start.value_or(start.start);
    if (start.is_bent)
      start.ahead = start.angle + angle_between(end - start.anchor, *tip.next_start + tips_.end_direction(tip));
  }
  FrontState state = state_of(tips_, tip);
  if (state.is_evaluated && !tip.now.path.added.empty()) {
    const Point way = tips_.position(tip, tip.now.path) - end;
    start.first_length = way.norm();
    start.first_angle = angle_of(way);
  }
  // Also of a tip that the mesh begins to follow in this step.
  start.least = (tips_.position(tip, tip.accepted.path) - end).norm();
  // A tip that is at another fracture or at the boundary grows no more by increments.
  const bool wants = start.goes_on || start.first_length > 0 || state.load > 1;
  const double reach = start.first_length + longest_advance * increment;
  const double free = wants ? tips_.free_distance(tip, {}, end + reach * ahead) : reach;
  is_blocked_.push_back(wants && state.is_evaluated && free < std::max(start.first_length, least_room * increment));
  if (is_blocked_.back()) {
    state.is_evaluated = false;
    start.first_length = 0;
    start.goes_on = false;
  }
  start.longest = start.covered + std::min(reach, free);
  at_start_.push_back(start);
  segments_.push_back(segment);
  states_.push_back(state);
}

/// The rock that is left between a blocked tip and another fracture breaks at once. Other blocked tips stop for good.
void TipsFront::end_blocked() {
  std::vector<std::pair<int, int>> joined;
  for (std::size_t i = 0; i < tips_.tips_.size(); ++i) {
    if (!is_blocked_[i]) continue;
    Tips::Tip& tip = tips_.tips_[i];
    if (tips_.options_.meeting == "join") {
      TipOutcome outcome;
      outcome.ahead = tips_.direction(tip);
      if (const auto joining = tips_.find_joining(tip, outcome, joinings_, joined)) {
        joined.emplace_back(tip.end.fracture, joining->other);
        joinings_.push_back(joining->extension);
        continue;
      }
    }
    const std::string name = tips_.name() + "." + tip.name;
    notes_.push_back({name + " is stopped at an obstacle",
                      fmt::format("{} stops at K_eq/K_IC = {:.4g} (the boundary or a fracture is too near ahead), "
                                  "and grows no more",
                                  name, tip.now.load),
                      tip.now.load});
  }
}

}  // namespace sprekk::fine_fracture
