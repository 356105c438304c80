// fracture_flow/tpfa: flow in fractures with the two-point flux approximation.
#include "components/fracture_flow/tpfa/fracture_flow.hpp"
#include "framework/scene/registry.hpp"

namespace sprekk::fracture_flow {
namespace {

const RegisterComponent<FractureFlow, Options> registration("fracture_flow/tpfa");

}  // namespace
}  // namespace sprekk::fracture_flow
