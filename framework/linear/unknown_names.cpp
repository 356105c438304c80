#include "framework/linear/unknown_names.hpp"

namespace sprekk {

std::string describe_unknown(const std::vector<UnknownBlock>& blocks, int unknown) {
  for (const UnknownBlock& block : blocks) {
    const int local = unknown - block.first;
    if (local < 0 || local >= block.entities * block.components) continue;
    std::string text = block.name + ", entity " + std::to_string(local / block.components);
    if (block.components > 1) text += ", component " + std::to_string(local % block.components);
    return text;
  }
  return "unknown " + std::to_string(unknown);
}

}  // namespace sprekk
