// The changes of fields by each pass of an iteration, and whether the passes converge.
#pragma once

#include <cstddef>
#include <vector>

namespace sprekk {

/// The changes of the fields by the passes of one step.
class PassChanges {
 public:
  /// `size`: norm of the change by a pass, all fields together, in scales that stay in the step; `relative`: the
  /// largest change of any field over the largest value of a field of its unit, before or after the pass.
  void add(double size, double relative);
  /// To be called when acceleration is switched on or off: later passes alone then show whether changes still fall.
  void begin_again() { begin_ = sizes_.size(); }

  /// Whether changes have grown in each of ten passes, and clearly over all ten.
  bool only_grow() const;
  /// Whether each of the last two passes has changed ten times as much as the one before, and the last one more than
  /// all values. Such passes leave the region in which the equations are nearly linear, where changes may stop growing.
  bool explode() const;
  /// Whether changes have stayed large over many passes without falling: a cycle, or an iteration that has diverged
  /// until other equations bounded it.
  bool stay_large(std::size_t passes) const;
  /// Whether changes are small and no longer fall.
  bool are_round_off() const;

  bool have_a_factor() const { return sizes_.size() > counted && sizes_.back() > 0; }
  /// The mean factor by which changes grow from pass to pass, over the last passes, in which the fastest growing part
  /// dominates.
  double factor() const;
  /// The factor between the last two passes.
  double last_factor() const { return sizes_.back() / sizes_[sizes_.size() - 2]; }
  double last_relative() const { return relative_.back(); }

 private:
  static constexpr std::size_t watched = 10, counted = 3;  // passes; those of the factor
  std::vector<double> sizes_, relative_;
  std::size_t begin_ = 0;
};

}  // namespace sprekk
