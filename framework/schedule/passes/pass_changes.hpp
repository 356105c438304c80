// What the passes of an iteration change, and whether they lead anywhere.
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
  /// From here on passes are others, with or without acceleration: those until now do not tell that they fall no more.
  void begin_again() { begin_ = sizes_.size(); }

  /// Whether they have grown in each of ten passes, and clearly in all.
  bool only_grow() const;
  /// Whether each of the last two passes has changed ten times as much as the one before, and the last one more than
  /// all values. Such passes leave the range in which the equations are the same, and go on without growing further.
  bool explode() const;
  /// Whether they have been large in so many passes without falling: a cycle, or an iteration that has diverged to
  /// where other equations hold it.
  bool stay_large(std::size_t passes) const;
  /// Whether they are small and fall no more.
  bool are_round_off() const;

  bool have_a_factor() const { return sizes_.size() > counted && sizes_.back() > 0; }
  /// The mean factor by which changes grow from pass to pass, over the last passes, in which the fastest growing part
  /// dominates.
  double factor() const;
  double last_factor() const { return sizes_.back() / sizes_[sizes_.size() - 2]; }  ///< of the last two passes alone
  double last_relative() const { return relative_.back(); }

 private:
  static constexpr std::size_t watched = 10, counted = 3;  // passes; those of the factor
  std::vector<double> sizes_, relative_;
  std::size_t begin_ = 0;
};

}  // namespace sprekk
