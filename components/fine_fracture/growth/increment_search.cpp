#include "components/fine_fracture/growth/increment_search.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

#include "components/fine_fracture/growth/kink.hpp"
#include "framework/invariants.hpp"

namespace sprekk::fine_fracture {

namespace {

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

constexpr int lengths_tried = 4;  ///< evaluations of an increment that is to end at the toughness, over `tries`

}  // namespace

IncrementSearch::IncrementSearch(const GrowthOptions& options, const Sifs& start, double toughness, double full_length,
                                 const WarmStart& before)
    : options_(options), start_(start), toughness_(toughness), warm_start_(before), full_length_(full_length) {
  SPREKK_EXPECT(toughness_ > 0, toughness_);
  SPREKK_EXPECT(full_length_ > 0, full_length_);
  SPREKK_EXPECT(is_finite(start_), start_.k1, start_.k2, start_.t_stress);
  length_ = first_length();
  if (!options_.is_implicit()) {
    has_direction_ = true;
    angle_ = clamp_turn(options_.relaxation *
                        (options_.releases_most() ? largest_release_angle(start_) : maximum_tangential_angle(start_)));
    return;
  }
  if (turns_away(start_, length_)) {
    // Where little growth is wanted, K_eq may fall to the toughness on the way to an increment that is turned away.
    const double shorter = longest_that_turns_back(start_);
    if (!options_.seeks_arrest() || !may_wait() || shorter < shortest_length()) {
      fix_direction("tension along the tip turns it away from where K_II vanishes");
      return;
    }
    length_ = shorter;
  }
  angle_ = local_symmetry_angle(start_, length_, options_.largest_turn);
}

double IncrementSearch::excess(const Sifs& sifs) const {
  return Front::excess({sifs, equivalent_sif(sifs) / toughness_});
}

double IncrementSearch::first_length() const {
  if (!options_.seeks_arrest()) return full_length_;
  // A shorter length is tried first only where the whole length is much too long: near the toughness a small change of
  // K_eq corresponds to a large change of the length, and tips that grow together share whole increments.
  constexpr double tolerances = 5;
  const double at_start = excess(start_);
  if (warm_start_.release * full_length_ - at_start < tolerances * options_.arrest_tolerance) return full_length_;
  return std::clamp(at_start / warm_start_.release, shortest_length(), full_length_);
}

/// A tip waits rather than grow by very little, but not where that would leave it well above the toughness.
double IncrementSearch::shortest_length() const {
  constexpr double part = 0.1;  // of the usual shortest increment, far above the toughness
  return (options_.seeks_arrest() && !may_wait() ? part : 1) * options_.smallest_length();
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
  full_length_ = std::max(0.0, free_length);
  if (free_length < shortest_length()) return stay();
  length_ = full_length_;
  front_.reset();
  good_.reset();
}

void IncrementSearch::stay() {
  length_ = 0;
  is_settled_ = is_last_ = true;
}

/// Begins the search of this tip alone, from the increment that was tried first.
void IncrementSearch::begin_front() {
  FrontTip tip;
  tip.toughness = toughness_;
  tip.longest = full_length_;
  tip.first_length = length_;
  tip.first_angle = angle_;
  tip.has_length = !options_.seeks_arrest();
  tip.has_angle = has_direction_;
  tip.largest_turn = options_.largest_turn;
  FrontOptions front;
  front.mesh_error = 0;
  front.direction_tolerance = std::atan(options_.direction_tolerance);
  front.load_tolerance = std::log1p(options_.arrest_tolerance);
  front.increment = options_.increment;
  front.shortest = shortest_length();
  front.most_trials = options_.tries * (options_.seeks_arrest() ? lengths_tried : 1);
  front.holds_state = true;
  front_.emplace(std::vector{tip}, std::vector{FrontState{start_, equivalent_sif(start_) / toughness_}}, front, 1);
}

void IncrementSearch::remember(const Sifs& end) {
  const Trial now{length_, angle_, end.k1 > 0 ? std::abs(end.k2) / end.k1 : std::numeric_limits<double>::infinity()};
  if (!nearest_ || now.shear < nearest_->shear) nearest_ = now;
  if (now.shear <= options_.direction_tolerance && equivalent_sif(end) >= toughness_ &&
      (!good_ || length_ > good_->length))
    good_ = now;
}

void IncrementSearch::learn(const Sifs& end) {
  SPREKK_EXPECT(is_finite(end), end.k1, end.k2, end.t_stress);
  SPREKK_ASSERT(length_ > 0, length_);
  if (is_last_) {
    is_settled_ = true;
    return;
  }
  if (is_settled_) {  // other tips have moved: earlier trials no longer count
    front_.reset();
    good_.reset();
    is_settled_ = false;
  }
  if (!front_) begin_front();
  remember(end);
  FrontState state{end, equivalent_sif(end) / toughness_};
  // The direction of a tip that is hardly loaded does not matter.
  if (!has_direction_ && !options_.seeks_arrest() && state.load <= options_.direction_tolerance) return settle(end);
  front_->learn({state});
  if (front_->verdict() == Front::Verdict::found) {
    settle(end);
    const bool is_right = has_direction_ || std::abs(end.k2) <= options_.direction_tolerance * end.k1;
    if (!options_.seeks_arrest() || (is_right && excess(end) >= std::log1p(-options_.arrest_tolerance))) return;
    if (!may_wait()) add_note("the length of arrest was not found: the tip waits");
    return stay();
  }
  if (front_->verdict() == Front::Verdict::failed) return give_up(end);
  length_ = front_->length(0);
  angle_ = front_->angle(0);
}

void IncrementSearch::settle(const Sifs& end) {
  is_settled_ = true;
  warm_start_.release = (excess(start_) - excess(end)) / length_;
}

void IncrementSearch::give_up(const Sifs& end) {
  constexpr double far_below = 0.9;  // of the toughness: an increment that ends there is longer than the tip would grow
  if (good_) {
    is_last_ = true;
    length_ = good_->length;
    angle_ = good_->angle;
  } else if (!has_direction_) {
    fix_direction("K_II did not vanish within the tries");
  } else if (options_.seeks_arrest() && equivalent_sif(end) < far_below * toughness_) {
    add_note("the length of arrest was not found: the tip waits");
    stay();
  } else {
    add_note("the length of arrest was not found within the tries");
    is_settled_ = is_last_ = true;
  }
}

void IncrementSearch::add_note(const std::string& note) { note_ += (note_.empty() ? "" : "; ") + note; }

void IncrementSearch::fix_direction(const std::string& why) {
  has_direction_ = true;
  front_.reset();
  // A nearly symmetric direction is better than the explicit one, which is unstable.
  constexpr double good_enough = 10;  // tolerances
  if (nearest_ && nearest_->shear <= good_enough * options_.direction_tolerance) {
    angle_ = nearest_->angle;
    add_note(why + ": the best direction was taken");
  } else {
    angle_ = clamp_turn(maximum_tangential_angle(start_));
    add_note(why + ": the direction of the maximum tangential stress was taken");
  }
}

}  // namespace sprekk::fine_fracture
