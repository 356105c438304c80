#include "framework/frame_output/registry.hpp"

#include "framework/plugin/insert_by_name.hpp"

namespace sprekk {

FrameOutputRegistry& FrameOutputRegistry::instance() {
  static FrameOutputRegistry registry;
  return registry;
}

void FrameOutputRegistry::add(Type type) { insert_by_name(types_, std::move(type), &Type::name); }

}  // namespace sprekk
