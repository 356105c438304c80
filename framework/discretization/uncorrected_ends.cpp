#include "framework/discretization/uncorrected_ends.hpp"

namespace sprekk {

UncorrectedEnds uncorrected_ends(const Mesh& mesh, const std::map<int, std::vector<int>>& cells_at,
                                 const std::function<std::string(int, const std::vector<int>&)>& why_not) {
  UncorrectedEnds found;
  for (const auto& [end, cells] : cells_at) {
    ++found.ends;
    const std::string reason = why_not(end, cells);
    if (reason.empty() || found.uncorrected++ > 0) continue;
    found.first = mesh.nodes[end];
    found.reason = reason;
  }
  return found;
}

}  // namespace sprekk
