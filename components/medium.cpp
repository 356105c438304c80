// Texts of the framework call the medium "rock": the components of this folder are those of a rock and its fractures.
#include "framework/mesh/medium.hpp"

namespace sprekk {
namespace {

const RegisterMedium registration("rock");

}  // namespace
}  // namespace sprekk
