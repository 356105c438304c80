// The interface of a part that adds up what has been stored, injected or flowed out.
#pragma once

namespace sprekk {

/// A part with totals of conserved quantities since the start of the run.
class KeepsTotals {
 public:
  virtual ~KeepsTotals() = default;
  /// Sets the totals to zero, for a run that begins with the state of another one.
  virtual void begin_totals() = 0;
};

}  // namespace sprekk
