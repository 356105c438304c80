// Parts that are far more accurate with time steps of two stages.
#pragma once

#include <string>

namespace sprekk {

/// A part to whose users two stages (TimeScheme::sdirk2) are recommended.
class GainsFromStages {
 public:
  virtual ~GainsFromStages() = default;
  /// What one stage costs in accuracy, as the rest of a sentence that begins with "with backward_euler"; empty where
  /// one stage costs too little for a note.
  virtual std::string loss_of_one_stage() const = 0;
};

}  // namespace sprekk
