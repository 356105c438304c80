// The advance of tips at one time where no stable growth is found: in small parts, until the load has come down.
#pragma once

#include <optional>
#include <vector>

#include "components/fine_fracture/growth/front.hpp"

namespace sprekk::fine_fracture {

/// Advances all tips above their toughness together, in parts of an increment, at one time and with the fluid that
/// there is, until no tip is above its toughness any more. Unlike Front it needs no load that falls with the length. It
/// is used as Front is: trials with lengths() and angles(), and learn() after each.
///
/// In each trial tips above the toughness advance by lengths in the ratio (G_i/max G)^0.35 (Eq. 13 of the paper), and
/// turn to where K_II vanishes by the expansion of a kink. When all are below it, the last part is shortened until the
/// largest load is at the toughness. Where the load drops from above the toughness to below it, as at the border of a
/// tougher layer, the jump ends behind the drop, by at most 1e-4 increments.
class FrontJump {
 public:
  FrontJump(std::vector<FrontTip> tips, const std::vector<FrontState>& without_growth, const FrontOptions& options);

  bool is_laid(int tip) const { return is_laid_[tip]; }
  double length(int tip) const { return now_.length[tip]; }  ///< m, of the last segment, covered part included
  double angle(int tip) const { return now_.angle[tip]; }    ///< rad, from the x axis
  /// The tip stays, whatever its load: where it was in the last trial above the toughness, at first at the start of the
  /// step.
  void stop(int tip);
  void learn(const std::vector<FrontState>& states);
  /// The last trial could not be solved, or laid: it is made shorter, and turns less. False when it is short already.
  bool retreat();
  /// too_far: a tip is still above its toughness where its advance in one step ends. The last trial holds all the same.
  Front::Verdict verdict() const { return verdict_; }
  double worst() const { return worst_; }  ///< the largest ln(K_eq/K_IC) in the last trial

  /// What is known of the jump of a tip.
  struct Record {
    double advance = 0;       ///< m
    double largest_load = 0;  ///< K_eq over K_IC
    /// m, the integral of G/G_c - 1 over the advance: times G_c it is the energy that was left over, per length of the
    /// front.
    double surplus = 0;
    bool is_unstable = false;  ///< whether the load rose with the length
  };
  const Record& record(int tip) const { return records_[tip]; }

  /// The largest K_eq over K_IC of all tips in the two trials between which the load drops, less than 1e-4 increments
  /// apart.
  struct Drop {
    double before = 0, behind = 0;
  };
  /// Where the jump has ended because the load drops. Empty where it has ended at the toughness.
  const std::optional<Drop>& drop() const { return drop_; }

 private:
  /// Positions of all tips, and their loads there.
  struct Place {
    std::vector<double> length, angle, load;
    double excess = 0;  ///< the largest ln(K_eq/K_IC)
  };
  int count() const { return static_cast<int>(tips_.size()); }
  /// Whether the tip takes part: those do that have a segment, or the first one to begin with.
  bool counts(int tip, const std::vector<FrontState>& states) const {
    const bool has_segment = tips_[tip].covered > 0 || tips_[tip].first_length > 0;
    return has_segment && !is_stopped_[tip] && states[tip].is_evaluated;
  }
  double largest_load(const std::vector<FrontState>& states) const;  ///< K_eq over K_IC
  void advance(const std::vector<FrontState>& states);
  void interpolate();
  void close_in();
  bool is_near(const Place& place, double part) const;
  void conclude();

  std::vector<FrontTip> tips_;
  FrontOptions options_;
  std::vector<char> is_laid_, is_stopped_;
  Place from_, to_, now_;    ///< above the toughness; below it, if known; the trial
  bool is_closing_ = false;  ///< whether `to_` is known
  bool was_below_ = false;   ///< whether the trial before the last one was below the toughness
  bool halves_ = false;      ///< the interval, in place of regula falsi
  bool is_last_ = false;     ///< the trial
  std::optional<Drop> drop_;
  std::vector<Record> records_;
  Front::Verdict verdict_ = Front::Verdict::again;
  double worst_ = 0;
};

}  // namespace sprekk::fine_fracture
