// The end of a run at a value of one of its quantities.
#pragma once

#include <string>
#include <vector>

#include "framework/assembly/part.hpp"
#include "framework/scene/scene.hpp"

namespace sprekk {

/// The condition `stop:` of `time:`. It is never reached in a scene without `stop:`.
class StopCondition {
 public:
  /// `quantities`: those of the scene. Throws InputError when the named quantity is not among them, or when the value
  /// has another unit.
  StopCondition(const Scene& scene, const std::vector<Quantity>& quantities);

  bool is_reached(const std::vector<Quantity>& quantities) const;
  std::string text() const;  ///< "fluid_injected has reached 3 m^2"
  /// "fluid_injected is 2 m^2, and has not reached 3 m^2"
  std::string missed_text(const std::vector<Quantity>& quantities) const;

 private:
  std::string name_;
  double value_ = 0;  ///< in the quantity's unit
  std::string reaches_, unit_;
};

}  // namespace sprekk
