// fracture_heat/tpfa: heat in fractures, conducted by two points.
#include "components/fracture_heat/fracture_heat.hpp"
#include "framework/scene/registry.hpp"

namespace sprekk::fracture_heat {
namespace {

const RegisterComponent<FractureHeat, Options> registration("fracture_heat/tpfa");

}  // namespace
}  // namespace sprekk::fracture_heat
