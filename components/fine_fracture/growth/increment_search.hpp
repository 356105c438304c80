// The search for the direction and the length of one increment of one tip.
#pragma once

#include <optional>
#include <string>

#include "components/fine_fracture/growth/front.hpp"
#include "components/fine_fracture/growth/growth_options.hpp"
#include "components/fine_fracture/growth/mixed_mode.hpp"

namespace sprekk::fine_fracture {

/// What an increment of a tip has measured, from which the search for its next one starts.
struct WarmStart {
  double release = 0;  ///< 1/m: the fall of ln K_eq over its length; unknown where this is not positive
};

/// Two conditions at the end of the increment, each met within its tolerance:
///   K_II = 0 (direction: implicit), and
///   K_eq(length) = K_IC, or length = the full length and K_eq >= K_IC       (length: arrest).
/// If the first trial does not meet them, Front searches for this tip alone, from there.
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
  /// An increment that was tried: m, rad, and |K_II/K_I| at its end.
  struct Trial {
    double length, angle, shear;
  };

  double excess(const Sifs& sifs) const;  ///< ln(K_eq/K_IC)
  double clamp_turn(double angle) const;
  double first_length() const;
  double shortest_length() const;
  bool may_wait() const;
  void begin_front();
  void remember(const Sifs& end);
  void give_up(const Sifs& end);
  /// Takes a direction in which all further lengths are tried.
  void fix_direction(const std::string& why);
  void settle(const Sifs& end);
  void stay();
  void add_note(const std::string& note);

  const GrowthOptions options_;
  const Sifs start_;
  const double toughness_;
  WarmStart warm_start_;
  double full_length_;
  double angle_ = 0, length_ = 0;
  bool is_limited_ = false, is_settled_ = false, has_direction_ = false, is_last_ = false;
  std::optional<Front> front_;
  std::optional<Trial> good_;     ///< the longest that meets the direction and ends at the toughness or above
  std::optional<Trial> nearest_;  ///< the one with the least K_II/K_I
  std::string note_;
};

}  // namespace sprekk::fine_fracture
