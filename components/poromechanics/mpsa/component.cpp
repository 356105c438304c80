// poromechanics/mpsa: deformation with the multi-point stress approximation.
#include "components/poromechanics/rock.hpp"
#include "framework/scene/registry.hpp"

namespace sprekk::poromechanics {
namespace {

const RegisterComponent<Rock, Options> registration("poromechanics/mpsa");

}  // namespace
}  // namespace sprekk::poromechanics
