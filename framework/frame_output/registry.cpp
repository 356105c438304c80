#include "framework/frame_output/registry.hpp"

#include <algorithm>

#include "framework/plugin/plugin.hpp"

namespace sprekk {

FrameOutputRegistry& FrameOutputRegistry::instance() {
  static FrameOutputRegistry registry;
  return registry;
}

void FrameOutputRegistry::add(Type type) {
  const auto place = std::ranges::lower_bound(types_, type.name, {}, &Type::name);
  if (place != types_.end() && place->name == type.name) return refuse_registration(type.name);
  note_registration(type.name);
  types_.insert(place, std::move(type));
}

}  // namespace sprekk
