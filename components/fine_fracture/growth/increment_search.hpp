// The search for the direction and the length of one increment of one tip.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "components/fine_fracture/growth/growth_options.hpp"
#include "components/fine_fracture/growth/mixed_mode.hpp"

namespace sprekk::fine_fracture {

/// What an increment of a tip has measured, from which the search for its next one starts.
struct WarmStart {
  double stiffness_ratio = 1;  ///< measured over estimated d phi/d angle
  double release = 0;          ///< 1/m: the fall of ln K_eq over its length; unknown where this is not positive
};

/// Two conditions at the end of the increment, each met within its tolerance:
///   phi(angle) = atan2(K_II, K_I) = 0       (direction: implicit), and
///   K_eq(length) = K_IC, or length = the full length and K_eq >= K_IC       (length: arrest).
/// Each condition is solved by its own secants while the other unknown changes, too: K_eq is stationary in the angle
/// where phi = 0 (Amestoy and Leblond 1992), so the two conditions hardly disturb each other as long as phi is small.
/// phi is used, and not K_II, because phi stays nearly linear for large turns and tells a closed tip, phi = pi, from
/// mode I.
///
/// An evaluation tells whether an increment is too short or too long only for the direction in which it was tried. So a
/// length becomes an end of the bracket only where its direction was right, up to an error that hardly changes K_eq.
/// Elsewhere the direction is corrected first. If that fails, the increment is made shorter, since the estimate of the
/// direction is exact in the limit; the next increment goes on from its end.
///
///   IncrementSearch search(…);
///   while (!search.is_settled()) search.learn(sifs at the end of the increment search.angle(), search.length());
class IncrementSearch {
 public:
  /// `start`: at the tip before the increment; `full_length` in m.
  IncrementSearch(const GrowthOptions& options, const Sifs& start, double toughness, double full_length,
                  const WarmStart& before = {});

  double angle() const { return angle_; }    ///< rad, counted from the direction ahead
  double length() const { return length_; }  ///< m, 0 when the tip is not to move
  /// Limits the length of the increment in its present direction.
  void limit_length(double free_length);
  bool is_limited() const { return is_limited_ && length_ == full_length_; }

  /// Takes the stress intensity factors at the end of the present increment, and either accepts the increment (settled)
  /// or changes its angle or length. May be called again for a settled search after other tips have moved: the search
  /// then settles again or goes on.
  void learn(const Sifs& end);

  bool is_settled() const { return is_settled_; }
  const WarmStart& warm_start() const { return warm_start_; }
  const std::string& note() const { return note_; }  ///< how the increment falls short of the options, or ""

 private:
  /// A direction that was tried, and its phi, rad.
  struct Direction {
    double angle, phi;
  };
  /// A length (m) that was tried with its angle (rad), and the excess at its end.
  struct Length {
    double length, excess, angle;
  };
  /// What may still change: angle and length, the length alone, or nothing.
  enum class Phase { searching, direction_fixed, as_it_is };

  bool is_direction_met(const Sifs& end) const;
  bool is_length_met(double k_eq) const;
  bool tells_of_length(const Sifs& end) const;
  double excess(double k_eq) const;
  double excess_in_right_direction(const Sifs& end) const;
  double estimated_slope(double angle) const;
  double clamp_turn(double angle) const;
  bool is_reversed() const;
  double root_of_phi();
  double first_length() const;
  bool may_wait() const;
  double next_length(const std::optional<Length>& third) const;
  double longer_length() const;
  void correct_direction(const Sifs& end);
  void change_length(double excess_here);
  bool has_closed(double excess_here) const;
  void shorten(double by);
  void go_to(double length);
  void settle(double k_eq);
  void settle_for_less(double k_eq);
  void accept_as_it_is();
  /// Returns to the longest length that is known to end at the toughness or above; without one the tip stays.
  void fall_back();
  void fix_direction(const std::string& why);
  void forget_lengths();
  void stay();
  void add_note(const std::string& note);

  const GrowthOptions options_;
  const Sifs start_;
  const double toughness_;
  WarmStart warm_start_;
  double full_length_;
  double angle_ = 0, length_ = 0;
  bool is_limited_ = false, is_settled_ = false;
  Phase phase_ = Phase::searching;
  int tries_ = 0;
  std::vector<Direction> directions_;  ///< tried with the present length
  Length shorter_;                     ///< an increment that is too short
  std::optional<Length> longer_;       ///< an increment that is too long
  std::optional<Length> good_;         ///< the longest that meets the direction and ends at the toughness or above
  double ceiling_;                     ///< m: no direction was found for this length, and longer ones are not tried
  std::string note_;
};

}  // namespace sprekk::fine_fracture
