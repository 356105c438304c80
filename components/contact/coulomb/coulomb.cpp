// contact/coulomb: the traction is an unknown, and the conditions hold exactly.
#include "components/contact/frictional_contact.hpp"
#include "framework/scene/registry.hpp"

namespace sprekk::contact {
namespace {

struct CoulombOptions : Options {
  Spec spec() {
    return Options::spec("contact/coulomb",
                         "Frictional contact of fracture walls with dilation (the paper's Eqs. 2, 3): each cell "
                         "sticks, slips or is open.");
  }
};

class Coulomb : public FrictionalContact {
 public:
  Coulomb(const ComponentContext& context, const CoulombOptions& options) : FrictionalContact(context, options) {}
};

const RegisterComponent<Coulomb, CoulombOptions> registration("contact/coulomb");

}  // namespace
}  // namespace sprekk::contact
