// The advance of tips at one time where no stable growth is found: in small parts, until the load has come down.
#pragma once

#include <functional>
#include <optional>
#include <vector>

#include "components/fine_fracture/growth/front.hpp"

namespace sprekk::fine_fracture {

/// Advances all tips above their toughness together, in parts of an increment, at one time and with the fluid that
/// there is, until no tip is above its toughness any more. Unlike Front it needs no load that falls with the length: it
/// follows the path by its length, however far, and so passes limit points. It is used as Front is: trials with
/// points(), and learn() after each.
///
/// In each trial tips above the toughness advance by lengths in the ratio (G_i/max G)^0.35 (Eq. 13 of the paper), and
/// turn to where K_II vanishes by the expansion of a kink. A segment that becomes longer than 1.5 increments is
/// divided: its last half increment goes on. When all tips are below the toughness, the last part is shortened until
/// the largest load is at the toughness. Where the load drops from above the toughness to below it, as at the border of
/// a tougher layer, the jump ends behind the drop, by at most 1e-4 increments.
class FrontJump {
 public:
  /// How far (m) a tip may go from a place of its path in this direction (unit vector); any length without it.
  using FreeLength = std::function<double(int tip, const Point& from, const Point& ahead)>;
  FrontJump(std::vector<FrontTip> tips, const std::vector<FrontState>& without_growth, const FrontOptions& options,
            FreeLength free_length = {});

  bool is_laid(int tip) const { return is_laid_[tip]; }
  /// m, from the anchor of the tip (exclusive) on; the last one is the tip.
  std::vector<Point> points(int tip) const;
  /// The direction in which its last segment begins, where that is an arc.
  const std::optional<Point>& start(int tip) const { return now_.courses[tip].start; }
  double advance(int tip) const { return now_.courses[tip].advance; }  ///< m, from the start of the step on
  double length(int tip) const { return now_.courses[tip].length; }  ///< m, of the last segment, covered part included
  double angle(int tip) const { return now_.courses[tip].angle; }    ///< rad, from the x axis
  /// The tip stays, whatever its load: where it was in the last trial above the toughness, at first at the start of the
  /// step.
  void stop(int tip);
  void learn(const std::vector<FrontState>& states);
  /// To be called when the last trial could not be solved, or its path not laid. Halves its way from the trial before.
  /// If what remains is too short, the jump ends at the last trial that was solved; returns false if there is none.
  bool retreat();
  /// too_far: a tip is still above its toughness where it can advance no further. The last trial holds all the same.
  Front::Verdict verdict() const { return verdict_; }
  bool is_left() const { return is_left_; }  ///< whether it ends where the next trial could not be solved
  double worst() const { return worst_; }    ///< the largest ln(K_eq/K_IC) in the last trial

  /// What is known of the jump of a tip.
  struct Record {
    double advance = 0;       ///< m
    double begins = 0;        ///< m, the part of the advance on which growth is stable: its load falls before it rises
    double largest_load = 0;  ///< K_eq over K_IC
    /// m, the integral of G/G_c - 1 over the rest of the advance: times G_c it is the energy that was left over, per
    /// length of the front.
    double surplus = 0;
    bool is_unstable = false;  ///< whether the load rose with the length
    bool falls = false;        ///< the load, in the last part
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
  /// The way of a tip: segments that stay, and the last one.
  struct Course {
    std::vector<Point> before;   ///< ends of segments that stay, m
    Point anchor;                ///< where the last segment begins, m
    std::optional<Point> start;  ///< unit vector, the direction in which it begins, where it is an arc
    double length, angle;        ///< of the last segment, m and rad
    double longest;              ///< m, most that the last segment may become
    double advance = 0;          ///< m
  };
  /// Courses of all tips, and their loads there.
  struct Place {
    std::vector<Course> courses;
    std::vector<double> load;
    double excess = 0;  ///< the largest ln(K_eq/K_IC)
  };
  static Course at_start(const FrontTip& tip);
  static Point end_of(const Course& course);
  int count() const { return static_cast<int>(tips_.size()); }
  /// Whether the tip takes part: those do that have a segment, or the first one to begin with.
  bool counts(int tip, const std::vector<FrontState>& states) const {
    const bool has_segment = tips_[tip].covered > 0 || tips_[tip].first_length > 0;
    return has_segment && !is_stopped_[tip] && states[tip].is_evaluated;
  }
  double largest_load(const std::vector<FrontState>& states) const;  ///< K_eq over K_IC
  void go_on(const std::vector<FrontState>& states);
  void divide_segment(int tip);
  void interpolate();
  void go_between(const Place& place, double part);
  void close_in();
  bool is_near(const Place& place, double part) const;
  void conclude();

  std::vector<FrontTip> tips_;
  FrontOptions options_;
  FreeLength free_length_;
  std::vector<char> is_laid_, is_stopped_;
  Place from_, to_, now_;    ///< above the toughness; below it, if known; the trial
  bool is_closing_ = false;  ///< whether `to_` is known
  bool was_below_ = false;   ///< whether the trial before the last one was below the toughness
  bool halves_ = false;      ///< the interval, in place of regula falsi
  bool is_last_ = false;     ///< the trial
  bool is_left_ = false;     ///< the jump: it could not be followed any further
  std::optional<Drop> drop_;
  std::vector<Record> records_;
  Front::Verdict verdict_ = Front::Verdict::again;
  double worst_ = 0;
};

}  // namespace sprekk::fine_fracture
