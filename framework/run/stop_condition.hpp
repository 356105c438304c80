// The end of a run at values of its quantities.
#pragma once

#include <string>
#include <vector>

#include "framework/assembly/part.hpp"
#include "framework/scene/scene.hpp"

namespace sprekk {

/// The condition `stop:` of `time:`. It is never reached in a scene without `stop:`.
class StopCondition {
 public:
  /// `quantities`: those of the scene. Throws InputError when a named quantity is not among them, or when a value
  /// has another unit.
  StopCondition(const Scene& scene, const std::vector<Quantity>& quantities);

  bool is_reached(const std::vector<Quantity>& quantities) const;
  /// Whether the quantities that the condition was made with have reached it: a run then ends with its first step,
  /// unless this step leads back.
  bool was_reached_at_start() const { return was_reached_at_start_; }
  std::string start_text() const;  ///< "slip.t is 0 m at the start"
  /// "fluid_injected has reached 3 m^2": the terms that hold.
  std::string text(const std::vector<Quantity>& quantities) const;
  /// "fluid_injected is 2 m^2, and has not reached 3 m^2": the terms that do not hold.
  std::string missed_text(const std::vector<Quantity>& quantities) const;

 private:
  struct Term {
    std::string name;
    bool falls = false;           ///< whether it is reached from above
    double value = 0, start = 0;  ///< in the quantity's unit
    std::string limit, unit;      ///< the value as the scene writes it, and the quantity's unit
    bool holds(const std::vector<Quantity>& quantities) const;
  };
  static Term read(const TimeOptions::StopTerm& given, const std::vector<Quantity>& quantities);

  std::vector<Term> terms_;
  bool needs_all_ = false;
  bool was_reached_at_start_ = false;
};

}  // namespace sprekk
