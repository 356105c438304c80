// given_friction: friction is multiplied by what another component gives.
#include <fmt/format.h>

#include "components/capabilities/given_on_fractures.hpp"
#include "framework/config/state.hpp"
#include "framework/mesh/geometry.hpp"
#include "framework/scene/registry.hpp"

namespace sprekk::couplers {
namespace {

struct GivenFrictionOptions {
  Spec spec() {
    Spec spec("given_friction",
              "The friction of a contact is that of its own law times the factor that another component gives.");
    spec.ignore("type").ignore("between");
    return spec;
  }
};

/// It has no terms: the contact takes the present factor where it asks for its strength.
class GivenFriction : public Coupler {
 public:
  GivenFriction(const CouplerContext& context, const GivenFrictionOptions&)
      : Coupler(context.name), mesh_(context.mesh), factor_(context.the<GivesFriction>().friction_factor()) {
    const std::string why_not = context.the<AcceptsFriction>().accept_friction_factor(factor_);
    if (!why_not.empty())
      throw InputError(context.origin, "coupler " + name() + " cannot change the friction", why_not,
                       "remove it, or choose another law of friction");
  }
  bool allows_stages() const override { return true; }
  void begin_step(const StepTime&) override {}
  /// Friction that is negative would push.
  void assemble(Assembly&, const StepTime&) const override {
    Eigen::Index cell = 0;
    if (factor_.size() > 0 && factor_.now().minCoeff(&cell) < 0)
      throw StateError(fmt::format("{} is {:.6g} at {}: a factor of friction is not negative", factor_.name(),
                                   factor_.now()[cell], to_text(mesh_.fracture_cells[cell].center)));
  }

 private:
  const Mesh& mesh_;
  const Field& factor_;
};

const RegisterCoupler<GivenFriction, GivenFrictionOptions> registration("given_friction");

}  // namespace
}  // namespace sprekk::couplers
