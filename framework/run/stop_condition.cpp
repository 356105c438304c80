#include "framework/run/stop_condition.hpp"

#include <fmt/format.h>

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
    falls_ = stop.falls_to.has_value();
    limit_ = falls_ ? *stop.falls_to : *stop.reaches;
    unit_ = quantity.unit;
    value_ = parse_quantity(limit_, quantity.unit, stop.origin, falls_ ? "falls_to" : "reaches");
    start_ = quantity.value;
  }
  if (name_.empty()) throw unknown_name(stop.origin, "quantity of history.csv", stop.of, names);
  was_reached_at_start_ = is_reached(quantities);
}

bool StopCondition::is_reached(const std::vector<Quantity>& quantities) const {
  return !name_.empty() && std::any_of(quantities.begin(), quantities.end(), [this](const Quantity& quantity) {
    return quantity.name == name_ && (falls_ ? quantity.value <= value_ : quantity.value >= value_);
  });
}

std::string StopCondition::text() const { return name_ + (falls_ ? " has fallen to " : " has reached ") + limit_; }

std::string StopCondition::start_text() const {
  return fmt::format("{} is {} at the start", name_, quantity_text(start_, unit_));
}

std::string StopCondition::missed_text(const std::vector<Quantity>& quantities) const {
  const std::string verb = falls_ ? "fallen to " : "reached ";
  for (const Quantity& quantity : quantities)
    if (quantity.name == name_)
      return name_ + " is " + quantity_text(quantity.value, unit_) + ", and has not " + verb + limit_;
  return name_ + " has not " + verb + limit_;
}

}  // namespace sprekk
