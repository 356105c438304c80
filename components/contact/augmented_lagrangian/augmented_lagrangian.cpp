// contact/augmented_lagrangian: springs between the walls, whose load multipliers take over. The conditions hold
// exactly.
#include "components/contact/frictional_contact.hpp"
#include "framework/scene/registry.hpp"

namespace sprekk::contact {
namespace {

struct AugmentedLagrangianOptions : Options {
  double stiffness = 100;  ///< over that of the rock
  Spec spec() {
    Spec spec = Options::spec("contact/augmented_lagrangian",
                              "Frictional contact by augmented Lagrangian: as by penalty, with multipliers that take "
                              "over the traction after each iteration (Simo and Laursen 1992), until the walls do not "
                              "overlap. The solution is that of contact/coulomb.");
    spec.quantity("stiffness_factor", stiffness,
                  {.range = positive(),
                   .doc = "Stiffness between the walls over that of the rock against a jump of one cell. An iteration "
                          "reduces the error by about this factor."});
    return spec;
  }
};

class AugmentedLagrangian : public FrictionalContact {
 public:
  AugmentedLagrangian(const ComponentContext& context, const AugmentedLagrangianOptions& options)
      : FrictionalContact(context, options, Multiplier::last, options.stiffness) {}
};

const RegisterComponent<AugmentedLagrangian, AugmentedLagrangianOptions> registration("contact/augmented_lagrangian");

}  // namespace
}  // namespace sprekk::contact
