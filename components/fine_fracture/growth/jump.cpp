#include "components/fine_fracture/growth/jump.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

#include "components/fine_fracture/growth/arc.hpp"
#include "components/fine_fracture/growth/front_limits.hpp"
#include "components/fine_fracture/growth/turn_slope.hpp"
#include "framework/invariants.hpp"

namespace sprekk::fine_fracture {

namespace {

/// That the leading tip advances from trial to trial: the surplus energy is integrated by trapezoids.
constexpr double part_of_increment = 0.25;
constexpr double length_power = 0.35;    ///< Eq. 13 of the paper
constexpr double full_segment = 1.5;     ///< of an increment: a longer segment is divided
constexpr double rest_of_segment = 0.5;  ///< of an increment: the part that may still turn
constexpr double least_part = 0.1;       ///< of the last part that regula falsi leaves
constexpr double shortest_part = 1e-2;   ///< of an increment: a trial that cannot be solved is shortened down to this
constexpr double least_drop = 0.02;      ///< ln(K_eq/K_IC) by which two trials this near to each other differ at a drop
constexpr double drop_part = 1e-4;       ///< of an increment: a drop is found to this
constexpr double least_load = 1e-3;      ///< for the logarithm

Point direction(double angle) { return {std::cos(angle), std::sin(angle)}; }

double angle_of(const Point& way) { return std::atan2(way[1], way[0]); }

double log_load(double load) { return std::log(std::max(least_load, load)); }

/// The change of direction that makes K_II vanish at the end of a segment, by the expansion of a kink.
double turn_of(const Sifs& sifs, double length, bool is_bent) {
  if (!(sifs.k1 > 0)) return 0;
  const double slope = short_kink_turn_slope + std::max(0.0, -sifs.t_stress) * std::sqrt(length) / sifs.k1;
  return std::clamp(-std::atan2(sifs.k2, sifs.k1) / (is_bent ? 2 * slope : slope), -largest_turn, largest_turn);
}

}  // namespace

FrontJump::Course FrontJump::at_start(const FrontTip& tip) {
  return {{}, tip.anchor, tip.is_bent ? std::optional(tip.start) : std::nullopt, tip.covered, tip.angle, tip.longest};
}

Point FrontJump::end_of(const Course& course) { return course.anchor + course.length * direction(course.angle); }

FrontJump::FrontJump(std::vector<FrontTip> tips, const std::vector<FrontState>& without_growth,
                     const FrontOptions& options, FreeLength free_length)
    : tips_(std::move(tips)),
      options_(options),
      free_length_(std::move(free_length)),
      is_laid_(tips_.size(), 0),
      is_stopped_(tips_.size(), 0),
      records_(tips_.size()) {
  SPREKK_EXPECT(without_growth.size() == tips_.size(), without_growth.size(), tips_.size());
  SPREKK_EXPECT(options_.increment > 0 && options_.shortest > 0, options_.increment, options_.shortest);
  for (int i = 0; i < count(); ++i) {
    const FrontTip& tip = tips_[i];
    now_.courses.push_back(at_start(tip));
    now_.load.push_back(counts(i, without_growth) ? without_growth[i].load : 0);
    records_[i].largest_load = now_.load.back();
    if (!(tip.first_length > 0)) continue;
    is_laid_[i] = 1;
    now_.courses[i].length = tip.first_length;
    now_.courses[i].angle = tip.first_angle;
  }
  from_ = now_;
  from_.excess = log_load(largest_load(without_growth));
  go_on(without_growth);
}

std::vector<Point> FrontJump::points(int tip) const {
  std::vector<Point> points = now_.courses[tip].before;
  points.push_back(end_of(now_.courses[tip]));
  return points;
}

void FrontJump::stop(int tip) {
  SPREKK_EXPECT(is_index(tip, count()), tip);
  is_stopped_[tip] = 1;
  is_laid_[tip] = records_[tip].advance > 0;
  if (!is_laid_[tip]) from_.courses[tip] = at_start(tips_[tip]);
  for (Place* place : {&to_, &now_})
    if (!place->courses.empty()) place->courses[tip] = from_.courses[tip];
  from_.load[tip] = 0;
  from_.excess = log_load(*std::ranges::max_element(from_.load));
}

double FrontJump::largest_load(const std::vector<FrontState>& states) const {
  double largest = 0;
  for (int i = 0; i < count(); ++i)
    if (counts(i, states)) largest = std::max(largest, states[i].load);
  return largest;
}

/// The first part of the last segment of a tip stays, and the rest goes on.
void FrontJump::divide_segment(int tip) {
  Course& course = from_.courses[tip];
  const double rest = rest_of_segment * options_.increment;
  const Point end = end_of(course);
  const PlaceOnPath place = place_on_segment(course.anchor, course.start, end, course.length - rest);
  course.before.push_back(place.position);
  course.anchor = place.position;
  course.start = place.direction;
  course.length = (end - place.position).norm();
  course.angle = angle_of(end - place.position);
  course.longest = course.length + (free_length_ ? free_length_(tip, end, direction(course.angle))
                                                 : std::numeric_limits<double>::infinity());
}

/// From the last trial, `from_`, to the next one.
void FrontJump::go_on(const std::vector<FrontState>& states) {
  const double largest = largest_load(states);
  const auto grows = [&](int i) { return counts(i, states) && states[i].load > 1; };
  for (int i = 0; i < count(); ++i)
    if (grows(i) && from_.courses[i].length >= full_segment * options_.increment) divide_segment(i);
  now_ = from_;
  bool has_advanced = false;
  for (int i = 0; i < count(); ++i) {
    if (!counts(i, states)) continue;
    Course& course = now_.courses[i];
    const double room = std::min(course.longest - course.length, options_.longest_jump - course.advance);
    const bool advances = grows(i) && room > at_limit * options_.increment;
    if (advances) {
      const double part = part_of_increment * std::pow(states[i].load / largest, 2 * length_power);
      course.length += std::min(room, part * options_.increment);
      course.advance += course.length - from_.courses[i].length;
      if (course.start)  // an arc keeps its curvature
        course.angle += std::remainder(course.angle - angle_of(*course.start), 2 * std::numbers::pi) *
                        (course.length / from_.courses[i].length - 1);
      has_advanced = true;
    }
    if (!advances && !is_laid_[i]) continue;
    course.angle += turn_of(states[i].sifs, course.length, course.start.has_value());
    is_laid_[i] = 1;
  }
  if (!has_advanced) verdict_ = Front::Verdict::too_far;
}

/// The next trial between one above the toughness and one below it, by regula falsi. From two trials on one side in
/// turn on the interval is halved, since the load may drop within it.
void FrontJump::interpolate() {
  const double zero = from_.excess / (from_.excess - to_.excess);
  const double part = halves_ ? 0.5 : std::clamp(zero, least_part, 1 - least_part);
  go_between(to_, part);
}

/// The trial that is this part of the way from `from_` to the place.
void FrontJump::go_between(const Place& place, double part) {
  for (int i = 0; i < count(); ++i) {
    const Course& from = from_.courses[i];
    const Course to = place.courses[i];
    Course& now = now_.courses[i];
    now.length = from.length + part * (to.length - from.length);
    now.angle = from.angle + part * (to.angle - from.angle);
    now.advance = from.advance + part * (to.advance - from.advance);
  }
}

/// Whether no tip advances by more than this part of an increment between `from_` and the place.
bool FrontJump::is_near(const Place& place, double part) const {
  for (int i = 0; i < count(); ++i)
    if (place.courses[i].advance - from_.courses[i].advance > part * options_.increment) return false;
  return true;
}

bool FrontJump::retreat() {
  go_between(now_, 0.5);
  if (!is_near(now_, shortest_part)) return true;
  const auto has_advanced = [](const Record& record) { return record.advance > 0; };
  if (is_left_ || std::ranges::none_of(records_, has_advanced)) return false;
  is_left_ = true;
  now_ = from_;
  return true;
}

void FrontJump::learn(const std::vector<FrontState>& states) {
  SPREKK_EXPECT(verdict_ == Front::Verdict::again);
  SPREKK_EXPECT(static_cast<int>(states.size()) == count(), states.size(), count());
  for (int i = 0; i < count(); ++i) now_.load[i] = counts(i, states) ? states[i].load : 0;
  worst_ = now_.excess = log_load(largest_load(states));
  if (is_left_) {
    verdict_ = Front::Verdict::too_far;
  } else if ((std::abs(now_.excess) <= options_.load_tolerance && (is_closing_ || now_.excess <= 0)) || is_last_) {
    conclude();
    verdict_ = Front::Verdict::found;
  } else if (now_.excess > 0) {
    conclude();
    from_ = now_;
    if (is_closing_)
      close_in();
    else
      go_on(states);
  } else {
    to_ = now_;
    is_closing_ = true;
    close_in();
  }
}

/// After a trial that is an end of the interval between `from_` and `to_`.
void FrontJump::close_in() {
  const bool is_below = now_.excess < 0;
  halves_ = halves_ || is_below == was_below_;
  was_below_ = is_below;
  const bool drops = from_.excess - to_.excess > least_drop;
  if (!is_near(to_, drops ? drop_part : shortest_part)) return interpolate();
  if (drops) drop_ = Drop{std::exp(from_.excess), std::exp(to_.excess)};
  is_last_ = true;
  now_ = to_;
  if (!is_below) return;  // one more trial, for the state there
  conclude();
  verdict_ = Front::Verdict::found;
}

/// Adds the part from `from_` to the trial to what is known of the jump.
void FrontJump::conclude() {
  for (int i = 0; i < count(); ++i) {
    Record& record = records_[i];
    const double advance = now_.courses[i].advance - from_.courses[i].advance;
    if (!(advance > 0)) continue;
    const auto excess = [](double load) { return load * load - 1; };
    // The first part begins on another mesh.
    if (record.advance > 0 && now_.load[i] > from_.load[i] && !record.is_unstable) {
      record.is_unstable = true;
      if (record.falls) {
        record.begins = record.advance;
        record.surplus = 0;
        record.largest_load = from_.load[i];
      }
    }
    record.falls = now_.load[i] < from_.load[i];
    record.surplus += 0.5 * (excess(from_.load[i]) + excess(now_.load[i])) * advance;
    record.largest_load = std::max(record.largest_load, now_.load[i]);
    record.advance += advance;
  }
}

}  // namespace sprekk::fine_fracture
