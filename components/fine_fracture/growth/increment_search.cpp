#include "components/fine_fracture/growth/increment_search.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "components/fine_fracture/growth/kink.hpp"

namespace sprekk::fine_fracture {

namespace {

double phase_of(const Sifs& sifs) { return std::atan2(sifs.k2, sifs.k1); }

/// A small turn changes K_II at the end of a straight increment by K_I/2 − 2 sqrt(2/pi) T sqrt(s) (Cotterell and Rice
/// 1980). With T > 0 paths are unstable themselves, and where the second term comes near to the first the straight
/// increment without K_II has nothing to do with them.
bool turns_away(const Sifs& sifs, double length) {
  return 4 * std::sqrt(2 / std::numbers::pi) * sifs.t_stress * std::sqrt(length) > 0.5 * equivalent_sif(sifs);
}

}  // namespace

IncrementSearch::IncrementSearch(const GrowthOptions& options, const Sifs& start, double toughness, double full_length,
                                 const Experience& before)
    : options_(options),
      start_(start),
      toughness_(toughness),
      experience_(before),
      full_length_(full_length),
      length_(full_length),
      best_{0, std::numbers::pi},
      shorter_{0, excess(equivalent_sif(start))},
      longer_{full_length, 0} {
  length_ = first_length();
  if (!options_.is_implicit()) {
    angle_ = clamp_turn(options_.relaxation * maximum_tangential_angle(start_));
    phase_ = Phase::direction_fixed;
  } else if (turns_away(start_, length_)) {
    fix_direction("tension along the tip turns it away from where K_II vanishes");
  } else {
    angle_ = local_symmetry_angle(start_, length_, options_.largest_turn);
  }
}

double IncrementSearch::first_length() const {
  // Only where the whole length is much too long: near the toughness a small part of K_eq is a large one of the length,
  // and whole increments are what tips that grow together have in common.
  constexpr double tolerances = 5;
  const double excess_of_whole = shorter_.excess + experience_.release * full_length_;
  if (!options_.seeks_arrest() || excess_of_whole < tolerances * options_.arrest_tolerance) return full_length_;
  return std::clamp(-shorter_.excess / experience_.release, options_.smallest_length(), full_length_);
}

double IncrementSearch::clamp_turn(double angle) const {
  return std::clamp(angle, -options_.largest_turn, options_.largest_turn);
}

void IncrementSearch::limit_length(double free_length) {
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
  shorter_ = {0, excess(equivalent_sif(start_))};
  longer_ = {full_length_, 0};
  has_longer_ = false;
  directions_.clear();
}

void IncrementSearch::stay() {
  length_ = 0;
  is_settled_ = true;
  phase_ = Phase::as_it_is;
}

bool IncrementSearch::is_direction_met(const Sifs& end) const {
  const double tolerance = options_.direction_tolerance;
  // A tip that hardly is loaded has no direction.
  return phase_ != Phase::searching || std::abs(end.k2) <= tolerance * end.k1 ||
         equivalent_sif(end) <= tolerance * toughness_;
}

bool IncrementSearch::is_length_met(double k_eq) const {
  if (!options_.seeks_arrest() || phase_ == Phase::as_it_is) return true;
  const double tolerance = options_.arrest_tolerance * toughness_;
  return k_eq >= toughness_ - tolerance && (length_ == full_length_ || k_eq <= toughness_ + tolerance);
}

double IncrementSearch::excess(double k_eq) const {
  // The logarithm lies between the two cases that there are: (K_IC/K_eq)^2 is linear in the length under point forces
  // and K_eq itself where confinement closes a wing. Continued by its tangent where K_eq comes near to 0.
  constexpr double switch_over = 0.3;
  const double ratio = k_eq / toughness_;
  return ratio >= switch_over ? -std::log(ratio) : -std::log(switch_over) + (switch_over - ratio) / switch_over;
}

double IncrementSearch::estimated_slope(double angle) const {
  constexpr double step = 1e-3;
  const double change =
      phase_of(after_kink(start_, angle + step, length_)) - phase_of(after_kink(start_, angle - step, length_));
  return std::max(0.1, std::remainder(change, 2 * std::numbers::pi) / (2 * step));
}

bool IncrementSearch::is_reversed() const {
  for (const Direction& a : directions_)
    for (const Direction& b : directions_)
      if (a.angle < b.angle && a.phi > 0 && b.phi < 0) return true;
  return false;
}

double IncrementSearch::root_of_phi() {
  const Direction& last = directions_.back();
  double slope = estimated_slope(last.angle) * experience_.stiffness_ratio;
  if (directions_.size() > 1) {
    const Direction& before = directions_[directions_.size() - 2];
    const double secant = (last.phi - before.phi) / (last.angle - before.angle);
    if (secant > 0.02 && secant < 100) {
      slope = secant;
      experience_.stiffness_ratio = std::clamp(secant / estimated_slope(last.angle), 0.1, 20.0);
    }
  }
  double root = clamp_turn(last.angle - last.phi / slope);
  double low = -options_.largest_turn, high = options_.largest_turn;
  for (const Direction& tried : directions_) {
    if (tried.phi < 0) low = std::max(low, tried.angle);
    if (tried.phi > 0) high = std::min(high, tried.angle);
  }
  if (low < high && (root < low || root > high)) root = (low + high) / 2;
  return root;
}

void IncrementSearch::learn(const Sifs& end) {
  if (phase_ == Phase::as_it_is) {
    is_settled_ = true;
    return;
  }
  ++tries_;
  const double phi = phase_of(end), k_eq = equivalent_sif(end);
  if (std::abs(phi) < std::abs(best_.phi)) best_ = {angle_, phi};
  const bool is_length_met_now = is_length_met(k_eq);
  is_settled_ = is_direction_met(end) && is_length_met_now;
  if (is_settled_) {
    experience_.release = (excess(k_eq) - excess(equivalent_sif(start_))) / length_;
    // Other tips may move yet, and what was found for their old places no longer binds.
    directions_.clear();
    return;
  }
  if (tries_ >= options_.tries && phase_ == Phase::direction_fixed) {
    // An increment that ends far below the toughness is more than the tip has grown.
    if (options_.seeks_arrest() && k_eq < 0.9 * toughness_) return fall_back();
    return accept_as_it_is();
  }

  const bool tells_direction = end.k1 > 0 || is_length_met_now;
  if (tries_ >= options_.tries && !tells_direction) {
    // Lengths have closed in on a jump of K, beyond which the tip is closed: with one direction for all of them it
    // ends.
    fix_direction("K_II did not vanish within the tries");
    return forget_lengths();
  }
  const double present = angle_;
  double root = angle_;
  if (phase_ == Phase::searching && tells_direction) {
    directions_.push_back({angle_, phi});
    root = root_of_phi();
    if (tries_ >= options_.tries && is_direction_met(end))
      keep_direction();
    else if (tries_ >= options_.tries)
      fix_direction("K_II did not vanish within the tries");
    else if (is_reversed())
      fix_direction("K_II grows with the turn that should remove it");
    else if (root == present && !is_direction_met(end))
      fix_direction("no direction within the largest turn makes K_II vanish");
    if (phase_ == Phase::direction_fixed) root = angle_;
  }
  // Where shear prevails the tip may be loaded too little only because it points the wrong way; where it is closed it
  // is too long.
  constexpr double far = 1;
  if (is_length_met_now || (std::abs(phi) >= far && end.k1 > 0 && root != present)) {
    angle_ = root;
    is_settled_ = is_length_met_now && root == present;
  } else {
    change_length(k_eq, root);
  }
}

double IncrementSearch::next_length(const std::optional<Length>& third) const {
  const double width = longer_.length - shorter_.length, middle = shorter_.length + width / 2;
  const double a = shorter_.excess, b = longer_.excess;
  if (!(a < 0 && b > 0)) return middle;
  double next = shorter_.length + width * a / (a - b);
  if (third && third->excess != a && third->excess != b) {
    // The parabola of the length over the excess through three points, as in Brent's method.
    const double c = third->excess;
    const double through_three = shorter_.length * b * c / ((a - b) * (a - c)) +
                                 longer_.length * a * c / ((b - a) * (b - c)) +
                                 third->length * a * b / ((c - a) * (c - b));
    if (through_three > shorter_.length && through_three < longer_.length) next = through_three;
  }
  const double margin = 2e-3 * width;
  return std::clamp(next, shorter_.length + margin, longer_.length - margin);
}

/// No increment that is too long is known yet.
double IncrementSearch::longer_length() const {
  constexpr double nearly = 0.7;
  const double slope = (shorter_.excess - excess(equivalent_sif(start_))) / shorter_.length;
  const double next = shorter_.length - shorter_.excess / slope;
  return slope > 0 && next < nearly * full_length_ ? next : full_length_;
}

void IncrementSearch::change_length(double k_eq, double root) {
  const Length here = {length_, excess(k_eq)};
  if (here.excess > 0 && length_ <= options_.smallest_length() * (1 + 1e-12)) return stay();
  Length& replaced = here.excess > 0 ? longer_ : shorter_;
  const std::optional<Length> third = has_longer_ ? std::optional(replaced) : std::nullopt;
  has_longer_ = has_longer_ || here.excess > 0;
  replaced = here;
  const double next = has_longer_ ? std::max(next_length(third), options_.smallest_length()) : longer_length();
  if (phase_ == Phase::searching) {
    // By how much the estimate is wrong vanishes with the length, where the estimate is exact.
    const double wrong = root - local_symmetry_angle(start_, length_, options_.largest_turn);
    angle_ = clamp_turn(local_symmetry_angle(start_, next, options_.largest_turn) + wrong * next / length_);
  }
  length_ = next;
  directions_.clear();
}

void IncrementSearch::accept_as_it_is() {
  phase_ = Phase::as_it_is;
  is_settled_ = true;
  note_ += std::string(note_.empty() ? "" : "; ") + "the length of arrest was not found within the tries";
}

void IncrementSearch::fall_back() {
  note_ += std::string(note_.empty() ? "" : "; ") + "the length of arrest was not found: the tip waits where it can";
  if (shorter_.length < options_.smallest_length()) return stay();
  phase_ = Phase::as_it_is;
  length_ = shorter_.length;
}

void IncrementSearch::keep_direction() {
  phase_ = Phase::direction_fixed;
  tries_ = 0;
}

void IncrementSearch::fix_direction(const std::string& why) {
  keep_direction();
  // Nearly symmetric is better than explicit, which is unstable.
  if (std::abs(std::tan(best_.phi)) <= 10 * options_.direction_tolerance && std::cos(best_.phi) > 0) {
    angle_ = best_.angle;
    note_ = why + ": the best direction was taken";
  } else {
    angle_ = clamp_turn(maximum_tangential_angle(start_));
    note_ = why + ": the direction of the maximum tangential stress was taken";
  }
}

}  // namespace sprekk::fine_fracture
