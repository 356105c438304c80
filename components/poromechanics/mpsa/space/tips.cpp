#include "components/poromechanics/mpsa/tips.hpp"

namespace sprekk::poromechanics {

Tips::Tips(const Mesh&, const MpsaLimits&) {}

std::span<const int> Tips::cells_near(int) const { return {}; }

bool Tips::has_same_zone(int, const Tips&, int) const { return true; }

void Tips::correct(int, const InteractionRegion&, std::span<const int>, const std::vector<Stiffness>&, LocalStresses&,
                   std::vector<Triplet>&) {}

}  // namespace sprekk::poromechanics
