// When an accelerated iteration continues without acceleration.
#pragma once

#include <limits>

namespace sprekk {

/// An accelerator learns from differences of passes. Once these are no larger than the errors of the solves inside, the
/// accelerator learns from noise and may keep passes from converging, while plain passes would converge. So after some
/// passes without progress the next passes are plain. If plain passes diverge (an iteration that converges only with
/// acceleration), they are undone, and not tried again in the step.
class StalledAcceleration {
 public:
  /// The kind of the next pass. `back`: an accelerated pass from the values before the first plain pass.
  enum class Next { accelerated, plain, back };

  /// To be called after each pass; returns the kind of the next one. `change`: norm of the change of the fields by the
  /// pass, scaled.
  Next after(double change) {
    if (is_plain_) {
      constexpr double clearly_more = 2;  // times the first change: plain passes are taken back
      if (change > clearly_more * first_) return stop(Next::back);
      return comes_nearer(change) ? Next::plain : stop(Next::accelerated);
    }
    if (was_tried_ || comes_nearer(change)) return Next::accelerated;
    is_plain_ = was_tried_ = true;
    passes_ = 0;
    first_ = best_ = change;
    return Next::plain;
  }
  /// To be called when the discrete state has changed: earlier passes then say nothing about later ones.
  void forget() { *this = {}; }

 private:
  bool comes_nearer(double change) {
    constexpr int patience = 6;   // passes: accelerators make changes rise for a few passes
    constexpr double less = 0.9;  // of the least change so far: accelerated changes may rise for a few passes
    passes_ = change < less * best_ ? 0 : passes_ + 1;
    if (passes_ == 0) best_ = change;
    return passes_ < patience;
  }
  Next stop(Next next) {
    is_plain_ = false;
    return next;
  }

  bool is_plain_ = false, was_tried_ = false;
  int passes_ = 0;  ///< number of passes since the last one whose change was clearly smaller than all before
  double best_ = std::numeric_limits<double>::infinity(), first_ = 0;
};

}  // namespace sprekk
