#include "framework/assembly/levels.hpp"

namespace sprekk {

void Levels::floats(const Field& field, const Origin& where, const std::string& why, const std::string& suggestion) {
  floating_[&field] = {where, why, suggestion};
}

void Levels::require_held() const {
  std::set<const Field*> held = held_;
  const auto is_held = [&](const Field* field) { return held.count(field) > 0 || floating_.count(field) == 0; };
  for (bool changed = true; changed;) {
    changed = false;
    for (const auto& [one, other] : ties_) {
      if (is_held(one) == is_held(other)) continue;
      held.insert({one, other});
      changed = true;
    }
  }
  for (const auto& [field, floating] : floating_)
    if (!is_held(field))
      throw InputError(floating.where, "the level of " + field->name() + " is not determined", floating.why,
                       floating.suggestion);
}

}  // namespace sprekk
