#include "framework/scene/law_kinds.hpp"

#include <algorithm>

namespace sprekk {

std::vector<LawKind>& law_kinds() {
  static std::vector<LawKind> kinds;
  return kinds;
}

RegisterLawKind::RegisterLawKind(LawKind kind) {
  // In the order of names, whatever the order of construction.
  const auto at = std::ranges::upper_bound(law_kinds(), kind.name, {}, &LawKind::name);
  law_kinds().insert(at, std::move(kind));
}

}  // namespace sprekk
