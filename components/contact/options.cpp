#include "components/contact/options.hpp"

namespace sprekk::contact {

Spec Options::spec(const std::string& type, const std::string& doc) {
  Spec spec(type, doc);
  spec.ignore("type");
  spec.data("friction", friction,
            {.range = non_negative(),
             .doc = "Coefficient of friction.",
             .source = "mu_s of the paper's Eq. 3",
             .required = true,
             .material = true,
             .in_time = true});
  spec.data("dilation_angle", dilation_angle,
            {.unit = "rad",
             .range = between(0, 1.5),
             .doc = "Angle by which slip opens the fracture, g = |slip| tan psi.",
             .source = "psi below the paper's Eq. 2",
             .material = true,
             .in_time = true});
  spec.quantity("dilation_limit", dilation_limit,
                {.unit = "m",
                 .range = non_negative(),
                 .doc = "Slip from where on it opens the fracture no further: its asperities are worn. Without it, "
                        "all slip opens."});
  spec.quantity("cohesion", weakening.cohesion,
                {.unit = "Pa",
                 .range = non_negative(),
                 .doc = "Shear traction that walls hold without pressure, |f_t| <= cohesion - friction f_n. "
                        "`weakening` says how it is lost."});
  spec.quantity("tensile_strength", weakening.tensile_strength,
                {.unit = "Pa",
                 .range = non_negative(),
                 .doc = "Normal traction at which walls part. `weakening` says how it is lost."});
  Spec lost("weakening", "How walls lose strength: linearly over a path, for good.");
  lost.quantity("distance", weakening.distance,
                {.unit = "m",
                 .range = positive(),
                 .doc = "Path of slip and opening, both ways counted, over which cohesion and tensile strength are "
                        "lost and friction falls to that of `friction`.",
                 .required = true});
  lost.data("friction", dynamic_friction,
            {.range = non_negative(),
             .doc = "Coefficient of friction after that; without it, friction stays.",
             .source = "linear slip weakening: Ida 1972, Andrews 1976",
             .in_time = true});
  spec.section("weakening", lost, {.doc = "How walls lose strength: linearly over a path, for good."}, &weakens);
  spec.section("closure", closure.spec(), {.doc = "How far walls in contact approach each other under pressure."});
  spec.check([this](const Node& node) {
    if (!weakens && weakening.cohesion > 0)
      throw InputError(node.origin, "'cohesion' is never lost", "the scene has no 'weakening'",
                       "add weakening: {distance: ...} with the path over which it is lost");
    if (!weakens && weakening.tensile_strength > 0)
      throw InputError(node.origin, "'tensile_strength' is never lost", "the scene has no 'weakening'",
                       "add weakening: {distance: ...} with the path over which it is lost");
  });
  spec.quantity("large_jump", large_jump,
                {.range = positive(),
                 .doc = "Jump over the length of its fracture from where on a note says that it is large: the places "
                        "and the shapes of fractures are taken to stay."});
  return spec;
}

}  // namespace sprekk::contact
