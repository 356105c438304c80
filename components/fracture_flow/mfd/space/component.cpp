// fracture_flow/mfd: flow in fractures with mimetic finite differences, for scenes in space. In a plane, where the
// cells of fractures are lines, they are two-point fluxes.
#include "components/fracture_flow/tpfa/fracture_flow.hpp"
#include "framework/scene/registry.hpp"

namespace sprekk::fracture_flow {
namespace {

struct MfdOptions : Options {
  Spec spec() {
    return Options::spec("fracture_flow/mfd",
                         "Flow along the fractures (the paper's Eq. 8): mimetic finite differences, exact for linear "
                         "pressures in cells of any shape.");
  }
};

struct Mfd : FractureFlow {
  Mfd(const ComponentContext& context, const MfdOptions& options) : FractureFlow(context, options) {
    drops_ = MimeticDrops(context.mesh);
  }
};

const RegisterComponent<Mfd, MfdOptions> registration("fracture_flow/mfd");

}  // namespace
}  // namespace sprekk::fracture_flow
