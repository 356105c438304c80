// The three types of contact. They differ in what multiplies the gap and the slip: see Multiplier.
#include "components/contact/options.hpp"
#include "framework/scene/registry.hpp"

namespace sprekk::contact {
namespace {

/// contact/coulomb: the traction is an unknown, and the conditions hold exactly.
struct CoulombOptions : Options {
  Spec spec() {
    return Options::spec("contact/coulomb",
                         "Frictional contact of fracture walls with dilation (the paper's Eqs. 2, 3): each cell "
                         "sticks, slips or is open.");
  }
  std::unique_ptr<Component> build(const ComponentContext& context) const {
    return frictional_contact(context, *this, Multiplier::present, 1);
  }
};

/// contact/penalty: springs between the walls. The error is of first order in their compliance.
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
  std::unique_ptr<Component> build(const ComponentContext& context) const {
    return frictional_contact(context, *this, Multiplier::none, stiffness);
  }
};

/// contact/augmented_lagrangian: springs between the walls, whose load multipliers take over. The conditions hold
/// exactly.
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
  std::unique_ptr<Component> build(const ComponentContext& context) const {
    return frictional_contact(context, *this, Multiplier::last, stiffness);
  }
};

/// Registers a type of contact with these options, as RegisterComponent does for a class that its source can read.
template <class TypeOptions>
struct RegisterContact {
  explicit RegisterContact(const std::string& name) {
    ComponentType type;
    type.type = name;
    type.spec = [] {
      static TypeOptions example;
      return example.spec();
    };
    type.read = [](const Node& node, const ReadContext& read) {
      auto options = std::make_shared<TypeOptions>();
      options->spec().read(node, read);
      return ComponentBuilder([options](const ComponentContext& context) { return options->build(context); });
    };
    Registry::instance().add(std::move(type));
  }
};

const RegisterContact<CoulombOptions> coulomb("contact/coulomb");
const RegisterContact<PenaltyOptions> penalty("contact/penalty");
const RegisterContact<AugmentedLagrangianOptions> augmented_lagrangian("contact/augmented_lagrangian");

}  // namespace
}  // namespace sprekk::contact
