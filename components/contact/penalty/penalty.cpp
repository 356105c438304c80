// contact/penalty: springs between the walls. The error is of first order in their compliance.
#include "components/contact/frictional_contact.hpp"
#include "framework/scene/registry.hpp"

namespace sprekk::contact {
namespace {

struct PenaltyOptions : Options {
  double stiffness = 100;  ///< over that of the rock
  Spec spec() {
    Spec spec = Options::spec("contact/penalty",
                              "Frictional contact by penalty: walls in contact overlap by traction over stiffness, and "
                              "slip elastically by as much before friction gives way. The error is of first order in "
                              "1/stiffness_factor.");
    spec.quantity(
        "stiffness_factor", stiffness,
        {.range = positive(), .doc = "Stiffness between the walls over that of the rock against a jump of one cell."});
    return spec;
  }
};

class Penalty : public FrictionalContact {
 public:
  Penalty(const ComponentContext& context, const PenaltyOptions& options)
      : FrictionalContact(context, options, Multiplier::none, options.stiffness) {}
};

const RegisterComponent<Penalty, PenaltyOptions> registration("contact/penalty");

}  // namespace
}  // namespace sprekk::contact
