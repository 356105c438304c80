#include "framework/run/stop_condition.hpp"

#include <algorithm>

#include "framework/config/units.hpp"

namespace sprekk {

StopCondition::StopCondition(const Scene& scene, const std::vector<Quantity>& quantities) {
  if (!scene.time.has_stop) return;
  const TimeOptions::Stop& stop = scene.time.stop;
  std::vector<std::string> names;
  for (const Quantity& quantity : quantities) {
    names.push_back(quantity.name);
    if (quantity.name != stop.of) continue;
    name_ = stop.of;
    reaches_ = stop.reaches;
    unit_ = quantity.unit;
    value_ = parse_quantity(stop.reaches, quantity.unit, stop.origin, "reaches");
  }
  if (name_.empty()) throw unknown_name(stop.origin, "quantity of history.csv", stop.of, names);
}

bool StopCondition::is_reached(const std::vector<Quantity>& quantities) const {
  return !name_.empty() && std::any_of(quantities.begin(), quantities.end(), [this](const Quantity& quantity) {
    return quantity.name == name_ && quantity.value >= value_;
  });
}

std::string StopCondition::text() const { return name_ + " has reached " + reaches_; }

std::string StopCondition::missed_text(const std::vector<Quantity>& quantities) const {
  for (const Quantity& quantity : quantities)
    if (quantity.name == name_)
      return name_ + " is " + quantity_text(quantity.value, unit_) + ", and has not reached " + reaches_;
  return name_ + " has not reached " + reaches_;
}

}  // namespace sprekk
