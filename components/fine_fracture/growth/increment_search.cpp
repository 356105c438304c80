#include "components/fine_fracture/growth/increment_search.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <utility>

#include "components/fine_fracture/growth/kink.hpp"
#include "framework/invariants.hpp"

namespace sprekk::fine_fracture {

namespace {

double phase_of(const Sifs& sifs) { return std::atan2(sifs.k2, sifs.k1); }

/// A small turn changes K_II at the end of a straight increment by K_I/2 − 2 sqrt(2/pi) T sqrt(s) (Cotterell and Rice
/// 1980). With T > 0 paths are unstable themselves, and where the second term comes near to the first the straight
/// increment without K_II has nothing to do with them.
bool turns_away(const Sifs& sifs, double length) {
  return 4 * std::sqrt(2 / std::numbers::pi) * sifs.t_stress * std::sqrt(length) > 0.5 * equivalent_sif(sifs);
}

/// Half of the longest increment that is not turned away, m, for T > 0.
double longest_that_turns_back(const Sifs& sifs) {
  const double root = equivalent_sif(sifs) / (8 * std::sqrt(2 / std::numbers::pi) * sifs.t_stress);
  return 0.5 * root * root;
}

constexpr const char* tension = "tension along the tip turns it away from where K_II vanishes";

/// abs(phi) up to which estimates for the right direction hold: `direction_tolerance` and `arrest_tolerance` alone
/// decide what is accepted.
constexpr double nearly_right = 0.5;

/// Part of the toughness: an increment that ends below it is longer than the tip would grow.
constexpr double far_below = 0.9;

/// The evaluations that one increment may take in all, over those that it may take with one length.
constexpr int lengths_tried = 4;

/// Relative differences of lengths and angles that sums of increments have by rounding.
constexpr double rounding = 1e-12;

}  // namespace

IncrementSearch::IncrementSearch(const GrowthOptions& options, const Sifs& start, double toughness, double full_length,
                                 const WarmStart& before)
    : options_(options),
      start_(start),
      toughness_(toughness),
      warm_start_(before),
      full_length_(full_length),
      length_(full_length) {
  SPREKK_EXPECT(toughness_ > 0, toughness_);
  SPREKK_EXPECT(full_length_ > 0, full_length_);
  SPREKK_EXPECT(is_finite(start_), start_.k1, start_.k2, start_.t_stress);
  forget_lengths();
  length_ = first_length();
  if (!options_.is_implicit()) {
    angle_ = clamp_turn(options_.relaxation *
                        (options_.releases_most() ? largest_release_angle(start_) : maximum_tangential_angle(start_)));
    phase_ = Phase::direction_fixed;
  } else if (turns_away(start_, length_) && !(options_.seeks_arrest() && may_wait() &&
                                              longest_that_turns_back(start_) >= options_.smallest_length())) {
    fix_direction(tension);
  } else {
    // Where little growth is wanted, K_eq may fall to the toughness on the way to an increment that is turned away.
    if (turns_away(start_, length_)) length_ = longest_that_turns_back(start_);
    angle_ = local_symmetry_angle(start_, length_, options_.largest_turn);
  }
}

double IncrementSearch::first_length() const {
  if (!options_.seeks_arrest()) return full_length_;
  if (!(warm_start_.release > 0))
    return longest_overloaded_kink(start_, toughness_, options_.smallest_length(), full_length_);
  // A shorter length is tried first only where the whole length is much too long: near the toughness a small change of
  // K_eq corresponds to a large change of the length, and tips that grow together share whole increments.
  constexpr double tolerances = 5;
  const double excess_of_whole = shorter_.excess + warm_start_.release * full_length_;
  if (excess_of_whole < tolerances * options_.arrest_tolerance) return full_length_;
  return std::clamp(-shorter_.excess / warm_start_.release, options_.smallest_length(), full_length_);
}

/// Whether the tip is hardly above its toughness.
bool IncrementSearch::may_wait() const {
  constexpr double tolerances = 2;  // of the arrest: within two of them the tip is at its toughness
  return equivalent_sif(start_) <= (1 + tolerances * options_.arrest_tolerance) * toughness_;
}

double IncrementSearch::clamp_turn(double angle) const {
  return std::clamp(angle, -options_.largest_turn, options_.largest_turn);
}

void IncrementSearch::limit_length(double free_length) {
  SPREKK_EXPECT(!std::isnan(free_length), free_length);
  if (free_length >= length_) return;
  is_limited_ = true;
  if (free_length < options_.smallest_length()) {
    full_length_ = 0;
    return stay();
  }
  full_length_ = free_length;
  forget_lengths();
}

void IncrementSearch::forget_lengths() {
  length_ = full_length_;
  shorter_ = {0, excess(equivalent_sif(start_)), 0};
  longer_.reset();
  good_.reset();
  ceiling_ = std::numeric_limits<double>::infinity();
  directions_.clear();
}

void IncrementSearch::stay() {
  length_ = 0;
  is_settled_ = true;
  phase_ = Phase::as_it_is;
}

bool IncrementSearch::is_direction_met(const Sifs& end) const {
  const double tolerance = options_.direction_tolerance;
  // The direction of a tip that is hardly loaded does not matter.
  return phase_ != Phase::searching || std::abs(end.k2) <= tolerance * end.k1 ||
         equivalent_sif(end) <= tolerance * toughness_;
}

bool IncrementSearch::is_length_met(double k_eq) const {
  if (!options_.seeks_arrest() || phase_ == Phase::as_it_is) return true;
  const double tolerance = options_.arrest_tolerance * toughness_;
  // Where no direction was found for twice the length, growth goes on with another increment from this end.
  const bool is_as_long_as_can_be = length_ == full_length_ || 2 * length_ >= ceiling_;
  return k_eq >= toughness_ - tolerance && (is_as_long_as_can_be || k_eq <= toughness_ + tolerance);
}

bool IncrementSearch::tells_of_length(const Sifs& end) const {
  if (phase_ != Phase::searching) return true;
  const double phi = phase_of(end);
  return std::abs(phi) < nearly_right && std::abs(excess_in_right_direction(end)) >= phi * phi;
}

/// K_eq is about K (1 + phi^2), with K_eq = K in the right direction (Eq. 10 of the paper to second order). For a kink
/// whose length plays a part, the estimate itself is wrong by about phi^2.
double IncrementSearch::excess_in_right_direction(const Sifs& end) const {
  const double phi = phase_ == Phase::searching ? phase_of(end) : 0;
  return excess(equivalent_sif(end)) + phi * phi;
}

double IncrementSearch::excess(double k_eq) const {
  // The logarithm lies between the two cases that there are: (K_IC/K_eq)^2 is linear in the length under point forces
  // and K_eq itself where confinement closes a wing. Continued by its tangent where K_eq comes near to 0.
  constexpr double switch_over = 0.3;
  const double ratio = k_eq / toughness_;
  return ratio >= switch_over ? -std::log(ratio) : -std::log(switch_over) + (switch_over - ratio) / switch_over;
}

double IncrementSearch::estimated_slope(double angle) const {
  constexpr double step = 1e-3;  // rad: rounding over it and the third derivative times its square are below 1e-6
  const double change =
      phase_of(after_kink(start_, angle + step, length_)) - phase_of(after_kink(start_, angle - step, length_));
  constexpr double least = 0.1;  // a flatter slope makes no useful step
  return std::max(least, std::remainder(change, 2 * std::numbers::pi) / (2 * step));
}

bool IncrementSearch::is_reversed() const {
  for (const Direction& a : directions_)
    for (const Direction& b : directions_)
      if (a.angle < b.angle && a.phi > 0 && b.phi < 0) return true;
  return false;
}

double IncrementSearch::root_of_phi() {
  SPREKK_ASSERT(!directions_.empty());
  const Direction& last = directions_.back();
  double slope = estimated_slope(last.angle) * warm_start_.stiffness_ratio;
  if (directions_.size() > 1) {
    const Direction& before = directions_[directions_.size() - 2];
    const double secant = (last.phi - before.phi) / (last.angle - before.angle);
    constexpr double flattest = 0.02, steepest = 100;     // slopes that are believed
    constexpr double least_ratio = 0.1, most_ratio = 20;  // of slopes, measured over estimated, that are remembered
    if (secant > flattest && secant < steepest) {
      slope = secant;
      if (std::max(std::abs(last.phi), std::abs(before.phi)) < nearly_right)
        warm_start_.stiffness_ratio = std::clamp(secant / estimated_slope(last.angle), least_ratio, most_ratio);
    }
  }
  constexpr double longest_step = 0.5;  // rad, as long as the root is not between two angles
  double root = clamp_turn(last.angle - std::clamp(last.phi / slope, -longest_step, longest_step));
  double low = -options_.largest_turn, high = options_.largest_turn;
  for (const Direction& tried : directions_) {
    if (tried.phi < 0) low = std::max(low, tried.angle);
    if (tried.phi > 0) high = std::min(high, tried.angle);
  }
  if (low < high && (root < low || root > high)) root = (low + high) / 2;
  return root;
}

void IncrementSearch::learn(const Sifs& end) {
  SPREKK_EXPECT(is_finite(end), end.k1, end.k2, end.t_stress);
  SPREKK_ASSERT(length_ > 0 && length_ <= full_length_ * (1 + rounding), length_, full_length_);
  SPREKK_ASSERT(std::abs(angle_) <= options_.largest_turn * (1 + rounding), angle_, options_.largest_turn);
  if (phase_ == Phase::as_it_is) {
    is_settled_ = true;
    return;
  }
  // Results for other positions of the other tips no longer count.
  if (is_settled_) {
    const double length = length_;
    forget_lengths();
    length_ = length;
  }
  ++tries_;
  const double k_eq = equivalent_sif(end);
  is_settled_ = is_direction_met(end) && is_length_met(k_eq);
  if (is_settled_) return settle(k_eq);
  if (std::abs(end.k2) <= options_.direction_tolerance * end.k1 && k_eq >= toughness_ &&
      (!good_ || length_ > good_->length))
    good_ = Length{length_, excess(k_eq), angle_};
  if (tries_ >= options_.tries * (options_.seeks_arrest() ? lengths_tried : 1)) return settle_for_less(k_eq);
  if (phase_ == Phase::searching) directions_.push_back({angle_, phase_of(end)});
  if (tells_of_length(end) && !is_length_met(k_eq))
    change_length(excess_in_right_direction(end));
  else
    correct_direction(end);
}

void IncrementSearch::settle(double k_eq) {
  SPREKK_ASSERT(length_ > 0, length_);
  // K_eq of a kink falls from that of an infinitesimal one.
  warm_start_.release = (excess(k_eq) - excess(equivalent_sif(after_kink(start_, angle_)))) / length_;
  directions_.clear();
}

void IncrementSearch::settle_for_less(double k_eq) {
  if (good_) {
    phase_ = Phase::as_it_is;
    length_ = good_->length;
    angle_ = good_->angle;
  } else if (phase_ == Phase::searching) {
    fix_direction("K_II did not vanish within the tries");
  } else if (options_.seeks_arrest() && k_eq < far_below * toughness_) {
    // An increment that ends far below the toughness is longer than the tip would grow.
    fall_back();
  } else {
    accept_as_it_is();
  }
}

void IncrementSearch::correct_direction(const Sifs& end) {
  // Beyond this angle the tip is closed, and the direction of growth does not follow from K_II.
  constexpr double closed = 0.75 * std::numbers::pi;
  const bool may_shorten = options_.seeks_arrest();
  if (may_shorten && std::abs(directions_.back().phi) >= closed) {
    const double linear = shorter_.excess / (shorter_.excess - excess(end.k1));
    directions_.clear();
    constexpr double shortest = 0.1, longest = 0.7;  // of the length: bounds of an estimate
    return shorten(std::clamp(linear, shortest, longest));
  }
  const double present = angle_, root = root_of_phi();
  if (is_reversed()) return fix_direction("K_II grows with the turn that should remove it");
  if (root == present && !may_shorten) return fix_direction("no direction within the largest turn makes K_II vanish");
  // K_II/K_I; and the part of a length whose direction is not found.
  constexpr double near_the_root = 0.2, about_a_third = 0.35;
  const int tries_with_one_length =
      std::abs(directions_.back().phi) < near_the_root ? options_.tries : std::max(2, options_.tries / 2);
  if (may_shorten && (root == present || static_cast<int>(directions_.size()) >= tries_with_one_length))
    return shorten(about_a_third);
  angle_ = root;
}

double IncrementSearch::next_length(const std::optional<Length>& third) const {
  SPREKK_ASSERT(longer_ && longer_->length >= shorter_.length, shorter_.length);
  const double width = longer_->length - shorter_.length, middle = shorter_.length + width / 2;
  const double a = shorter_.excess, b = longer_->excess;
  if (!(a < 0 && b > 0)) return middle;
  double next = shorter_.length + width * a / (a - b);
  if (third && third->excess != a && third->excess != b) {
    // The parabola of the length over the excess through three points, as in Brent's method.
    const double c = third->excess;
    const double through_three = shorter_.length * b * c / ((a - b) * (a - c)) +
                                 longer_->length * a * c / ((b - a) * (b - c)) +
                                 third->length * a * b / ((c - a) * (c - b));
    if (through_three > shorter_.length && through_three < longer_->length) next = through_three;
  }
  constexpr double margin = 2e-3;  // of the bracket: a length at one of its ends would not narrow it
  return std::clamp(next, shorter_.length + margin * width, longer_->length - margin * width);
}

/// The next length to try as long as no increment is known to be too long.
double IncrementSearch::longer_length() const {
  constexpr double nearly = 0.7;  // of the longest length: a longer estimate is not tried
  const double slope = (shorter_.excess - excess(equivalent_sif(start_))) / shorter_.length;
  const double next = shorter_.length - shorter_.excess / slope;
  const double longest = std::min(full_length_, 0.5 * (shorter_.length + ceiling_));
  return slope > 0 && next < nearly * longest ? next : longest;
}

void IncrementSearch::change_length(double excess_here) {
  const Length here = {length_, excess_here, angle_};
  if (here.excess > 0 && length_ <= options_.smallest_length() * (1 + rounding)) {
    warm_start_.release = (here.excess - excess(equivalent_sif(start_))) / length_;
    return stay();
  }
  std::optional<Length> third;
  if (here.excess > 0) {
    third = std::exchange(longer_, here);
  } else {
    if (longer_) third = shorter_;
    shorter_ = here;
  }
  if (has_closed(here.excess)) {
    // There is nothing to bisect: the last length is right, and the other end of the bracket no longer is.
    if (here.excess > 0)
      shorter_ = {0, excess(equivalent_sif(start_)), 0};
    else
      longer_.reset();
    third.reset();
  }
  go_to(longer_ ? std::max(next_length(third), options_.smallest_length()) : longer_length());
}

/// Whether the bracket is narrower than K_eq allows, since K_eq would change with more than the fifth power of the
/// length: then one of its ends is no longer right.
bool IncrementSearch::has_closed(double excess_here) const {
  constexpr double steepest = 5;  // power of the length with which K_eq may change
  return phase_ == Phase::searching && longer_ &&
         steepest * (longer_->length - shorter_.length) < std::abs(excess_here) * longer_->length;
}

void IncrementSearch::shorten(double by) {
  SPREKK_EXPECT(by > 0 && by < 1, by);
  if (length_ <= options_.smallest_length() * (1 + rounding))
    return fix_direction("no direction makes K_II vanish, not even with the shortest increment");
  ceiling_ = length_;
  longer_.reset();
  const double shorter = std::max(by * length_, 0.5 * (shorter_.length + length_) * (shorter_.length > 0));
  go_to(std::max(shorter, options_.smallest_length()));
}

/// Changes the length, and estimates the direction for it from the directions that were tried with the present length.
void IncrementSearch::go_to(double length) {
  SPREKK_EXPECT(length > 0 && std::isfinite(length), length);
  if (phase_ == Phase::searching && turns_away(start_, length)) fix_direction(tension);
  if (phase_ == Phase::searching) {
    // The error of the estimate vanishes with the length.
    const double root = directions_.empty() ? angle_ : root_of_phi();
    const double wrong = root - local_symmetry_angle(start_, length_, options_.largest_turn);
    angle_ = clamp_turn(local_symmetry_angle(start_, length, options_.largest_turn) + wrong * length / length_);
  }
  length_ = length;
  directions_.clear();
}

void IncrementSearch::add_note(const std::string& note) { note_ += (note_.empty() ? "" : "; ") + note; }

void IncrementSearch::accept_as_it_is() {
  phase_ = Phase::as_it_is;
  is_settled_ = true;
  add_note("the length of arrest was not found within the tries");
}

void IncrementSearch::fall_back() {
  add_note("the length of arrest was not found: the tip waits where it can");
  if (shorter_.length < options_.smallest_length()) return stay();
  phase_ = Phase::as_it_is;
  length_ = shorter_.length;
  angle_ = shorter_.angle;
}

/// Takes a direction in which all further lengths are tried.
void IncrementSearch::fix_direction(const std::string& why) {
  phase_ = Phase::direction_fixed;
  tries_ = 0;
  const auto best =
      std::min_element(directions_.begin(), directions_.end(),
                       [](const Direction& a, const Direction& b) { return std::abs(a.phi) < std::abs(b.phi); });
  // A nearly symmetric direction is better than the explicit one, which is unstable.
  constexpr double good_enough = 10;  // tolerances
  if (best != directions_.end() && std::abs(std::tan(best->phi)) <= good_enough * options_.direction_tolerance &&
      std::cos(best->phi) > 0) {
    angle_ = best->angle;
    add_note(why + ": the best direction was taken");
  } else {
    angle_ = clamp_turn(maximum_tangential_angle(start_));
    add_note(why + ": the direction of the maximum tangential stress was taken");
  }
  const double length = length_;
  forget_lengths();
  length_ = length;
}

}  // namespace sprekk::fine_fracture
