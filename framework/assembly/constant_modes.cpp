#include "framework/assembly/constant_modes.hpp"

#include <algorithm>

#include "framework/invariants.hpp"

namespace sprekk {

void ConstantModes::floats(const Field& field, const Origin& where, const std::string& why,
                           const std::string& suggestion) {
  SPREKK_EXPECT(!why.empty(), field.name());
  if (!floats(&field)) floating_.push_back({&field, where, why, suggestion});
}

void ConstantModes::hold(const Field& field) { held_.insert(&field); }

void ConstantModes::tie(const Field& one, const Field& other) { ties_.emplace_back(&one, &other); }

bool ConstantModes::floats(const Field* field) const {
  return std::any_of(floating_.begin(), floating_.end(), [&](const Floating& one) { return one.field == field; });
}

void ConstantModes::require_held() const {
  std::set<const Field*> held = held_;
  const auto is_held = [&](const Field* field) { return held.count(field) > 0 || !floats(field); };
  for (bool changed = true; changed;) {
    changed = false;
    for (const auto& [one, other] : ties_) {
      if (is_held(one) == is_held(other)) continue;
      held.insert({one, other});
      changed = true;
    }
  }
  for (const Floating& floating : floating_)
    if (!is_held(floating.field))
      throw InputError(floating.where, "the constant mode of " + floating.field->name() + " is not determined",
                       floating.why, floating.suggestion);
}

}  // namespace sprekk
