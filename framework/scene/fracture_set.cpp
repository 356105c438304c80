#include "framework/scene/fracture_set.hpp"

#include <algorithm>

#include "framework/name_pattern.hpp"

namespace sprekk {

std::vector<char> fracture_set(const Mesh& mesh, const std::vector<std::string>& names, const Origin& origin) {
  if (names.empty()) return {};
  std::vector<std::string> known;
  for (const Fracture& fracture : mesh.fractures) known.push_back(fracture.name);
  for (const std::string& name : names)
    if (std::ranges::none_of(known, [&](const std::string& one) { return stands_for(name, one); }))
      throw unknown_name(origin, "fracture", name, known);
  std::vector<char> flags(mesh.fracture_cell_count());
  for (int i = 0; i < mesh.fracture_cell_count(); ++i)
    flags[i] = std::ranges::any_of(
        names, [&](const std::string& name) { return stands_for(name, known[mesh.fracture_cells[i].fracture]); });
  if (std::ranges::count(flags, 0) == 0) return {};
  return flags;
}

}  // namespace sprekk
