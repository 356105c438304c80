// The three types of contact, which differ in their Multiplier, and their parameters.
#include <fmt/format.h>

#include "components/capabilities/usual_ranges.hpp"
#include "components/contact/laws/formulas.hpp"
#include "components/contact/options.hpp"
#include "framework/config/state.hpp"
#include "framework/scene/registry.hpp"

namespace sprekk::contact {

namespace {

void add_dilation(Spec& spec, Options& options) {
  spec.data("dilation_angle", options.dilation_angle,
            {.unit = "rad",
             .range = between(0, 1.5),
             .doc = "Angle by which slip opens the fracture, g = |slip| tan psi.",
             .source = "psi below the paper's Eq. 2",
             .material = true,
             .in_time = true});
  usually(spec, "dilation_angle", usual_dilation_angle());
  spec.quantity("dilation_limit", options.dilation_limit,
                {.unit = "m",
                 .range = non_negative(),
                 .doc = "Slip beyond which the fracture opens no further: its asperities are worn. Without it, "
                        "all slip opens."});
  spec.data("dilation", options.dilation,
            {.unit = "m",
             .range = non_negative(),
             .doc = "Opening by slip, instead of dilation_angle and dilation_limit: a formula, 0 without slip.",
             .in_time = true});
  may_be_formula(spec.name(), "dilation", dilation_variables());
}

Spec weakening_spec(Options& options) {
  Spec lost("weakening", "How walls lose strength: linearly over a path, for good.");
  lost.quantity("distance", options.weakening.distance,
                {.unit = "m",
                 .range = positive(),
                 .doc = "Path of slip and opening, both ways counted, over which cohesion and tensile strength are "
                        "lost and friction falls to that of `friction`.",
                 .required = true});
  lost.data("friction", options.dynamic_friction,
            {.range = non_negative(),
             .doc = "Coefficient of friction after that; without it, friction stays.",
             .source = "linear slip weakening: Ida 1972, Andrews 1976",
             .in_time = true});
  return lost;
}

/// Refuses values that exclude each other, or have no effect.
void check_laws(const Options& options, const Node& node) {
  for (const char* other : {"dilation_angle", "dilation_limit"})
    if (options.dilation && node.find(other))
      throw InputError(node.find("dilation")->origin, fmt::format("'dilation' and '{}' exclude each other", other),
                       "each says how far slip opens the fracture", "remove one of them");
  if (options.dilation_limit && options.dilation_angle.is_zero())
    throw InputError(node.find("dilation_limit")->origin, "'dilation_limit' has no effect",
                     "slip opens nothing without a 'dilation_angle'", "add one, or remove it");
  if (options.weakens && options.cohesion.is_zero() && options.weakening.tensile_strength == 0 &&
      !options.dynamic_friction)
    throw InputError(node.find("weakening")->origin, "'weakening' has no effect",
                     "there is no cohesion or tensile strength to lose, and friction stays",
                     "add one of these, or the 'friction' that is left");
  if (options.dilation && options.dilation->is_constant() && !options.dilation->is_zero())
    throw InputError(node.find("dilation")->origin, "'dilation' does not depend on the slip",
                     "it is the opening that slip makes", "write a formula of slip, such as 0.1*slip");
  if (options.friction_law.type != "constant" && (options.dynamic_friction || options.depends_on_rate))
    throw InputError(
        node.find("friction_law")->origin, "the law of friction is given twice",
        options.depends_on_rate ? "'rate_and_state' is another one" : "'friction' of 'weakening' is another one",
        "remove one of them");
  if (options.weakens && options.depends_on_rate)
    throw InputError(node.find("rate_and_state")->origin, "'rate_and_state' and 'weakening' exclude each other",
                     "each says how friction changes with slip", "remove one of them");
  if (options.depends_on_rate && !options.cohesion.is_zero())
    throw InputError(node.find("cohesion")->origin, "'cohesion' has no effect",
                     "with 'rate_and_state' walls always creep, and hold what that law says", "remove one of them");
  if (!options.weakens && options.weakening.tensile_strength > 0)
    throw InputError(node.origin, "'tensile_strength' is never lost", "the scene has no 'weakening'",
                     "add weakening: {distance: ...} with the path over which it is lost");
}

}  // namespace

Spec Options::spec(const std::string& type, const std::string& doc) {
  Spec spec(type, doc);
  spec.ignore("type");
  history.declare(spec, strength_variables());
  spec.data("friction", friction,
            {.range = non_negative(),
             .doc = "Coefficient of friction.",
             .source = "mu_s of the paper's Eq. 3",
             .required = true,
             .material = true,
             .in_time = true});
  usually(spec, "friction", usual_friction());
  may_be_formula(spec.name(), "friction", strength_variables());
  spec.section("friction_law", friction_law.spec(),
               {.doc = "How friction changes with slip, path, slip rate and pressure, from `friction` on."});
  add_dilation(spec, *this);
  spec.data("cohesion", cohesion,
            {.unit = "Pa",
             .range = non_negative(),
             .doc = "Shear traction that walls in contact hold without pressure, |f_t| <= cohesion - friction f_n. "
                    "Open walls hold nothing, unless `weakening` says how it is lost.",
             .in_time = true});
  usually(spec, "cohesion", usual_strength());
  may_be_formula(spec.name(), "cohesion", strength_variables());
  spec.quantity("tensile_strength", weakening.tensile_strength,
                {.unit = "Pa",
                 .range = non_negative(),
                 .doc = "Normal traction at which walls part. `weakening` says how it is lost."});
  usually(spec, "tensile_strength", usual_strength());
  spec.section("weakening", weakening_spec(*this), {.doc = "How walls lose strength: linearly over a path, for good."},
               &weakens);
  spec.section("rate_and_state", rate_and_state.spec(),
               {.doc = "Friction that depends on slip rate and on a state that ages, with the friction of steady slip "
                       "from `friction`."},
               &depends_on_rate);
  spec.section("closure", closure.spec(), {.doc = "How far walls in contact approach each other under pressure."});
  spec.check([this](const Node& node) {
    if (const Node* given = node.find("fractures")) fractures_origin = given->origin;
    weakening.cohesion = cohesion.is_constant() ? cohesion.at({}) : 0;
    check_laws(*this, node);
  });
  spec.quantity("large_jump", large_jump,
                {.range = positive(),
                 .doc = "A note tells of a jump above this share of the length of its fracture: the model keeps places "
                        "and shapes of fractures."});
  spec.texts("fractures", fractures,
             {.doc = "Fractures with this contact, `joints_*` for all that begin so; all by default. Each fracture "
                     "needs one contact: others are given to "
                     "other components of this kind, beside it."});
  return spec;
}

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
    spec.check([this](const Node& node) {
      if (depends_on_rate)
        throw InputError(node.find("rate_and_state")->origin, "contact/penalty has no 'rate_and_state'",
                         "its walls slip elastically before friction gives way, and that slip would count as slip rate",
                         "take contact/coulomb or contact/augmented_lagrangian");
    });
    spec.quantity(
        "stiffness_factor", stiffness,
        {.range = positive(), .doc = "Stiffness between the walls over that of the rock against a jump of one cell."});
    return spec;
  }
  std::unique_ptr<Component> build(const ComponentContext& context) const {
    return frictional_contact(context, *this, Multiplier::none, stiffness);
  }
};

/// contact/augmented_lagrangian: springs between the walls, whose forces are taken over by multipliers. The conditions
/// hold exactly.
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
