#include "components/fracture_flow/laws/law_options.hpp"

#include <algorithm>

#include "components/capabilities/usual_ranges.hpp"
#include "components/fracture_flow/laws/formula_law.hpp"
#include "framework/config/state.hpp"

namespace sprekk::fracture_flow {

Spec LawOptions::spec() {
  Spec spec("law", "How well the fracture conducts, by its aperture a.");
  spec.choice(
      "type", type, hydraulic_laws().names(),
      {.doc = "How the tangential transmissivity K_i follows from the aperture.", .source = "below the paper's Eq. 8"});
  spec.quantity("residual", residual,
                {.unit = "m",
                 .range = positive(),
                 .doc = "Least hydraulic aperture, which a closed fracture has. It conducts, and has no volume."});
  spec.quantity("roughness", roughness,
                {.unit = "m",
                 .range = non_negative(),
                 .doc = "Height of the asperities of a rough fracture.",
                 .source = "Lomize 1951; Witherspoon et al. 1980"});
  spec.data("transmissivity", transmissivity,
            {.unit = "m^3", .range = non_negative(), .doc = "Of the constant law, or a formula.", .in_time = true});
  may_be_formula(spec.name(), "transmissivity", conduction_variables());
  usually(spec, "transmissivity", usual_transmissivity());
  spec.data(
      "inertia", inertia,
      {.unit = "1/m",
       .range = non_negative(),
       .doc = "Forchheimer's coefficient beta, which adds beta rho Q |Q|/h^2 to the pressure gradient 12 mu Q/h^3 "
              "of the flux Q in the hydraulic aperture h; 0 without inertia.",
       .source = "Forchheimer 1901; Zimmerman et al. 2004",
       .in_time = true});
  registered.add_sections(spec, hydraulic_laws());
  spec.check([this](const Node& node) {
    registered.check(node, type, "type");
    const bool is_constant = type == "constant", is_given = is_constant || type == "formula";
    if (is_given && !transmissivity)
      throw InputError(node.origin, "'transmissivity' is missing",
                       is_constant ? "the law is constant" : "the law is a formula", "give it in m^3");
    if (!is_given && transmissivity)
      throw InputError(node.origin, "'transmissivity' has no effect",
                       "it follows from the aperture by the " + type + " law",
                       "write 'type: constant' or 'type: formula', or remove it");
    if (is_constant && residual)
      throw InputError(node.origin, "'residual' has no effect",
                       "a constant transmissivity does not depend on the aperture",
                       "remove it, or write 'type: cubic'");
    if (type == "rough" && !roughness)
      throw InputError(node.origin, "'roughness' is missing", "the law is that of a rough fracture", "give it in m");
    if (type != "rough" && roughness)
      throw InputError(node.origin, "'roughness' has no effect", "the " + type + " law has no roughness",
                       "write 'type: rough', or remove it");
  });
  return spec;
}

std::unique_ptr<HydraulicLaw> LawOptions::make(double floor) const {
  const double lowest = std::max(floor, residual.value_or(0));
  if (auto law = registered.build(type, lowest)) return law;
  // Where the transmissivity is given, the aperture across the fracture is that of smooth walls.
  return make_hydraulic_law(type == "constant" || type == "formula" ? "cubic" : type, {lowest, roughness.value_or(0)});
}

}  // namespace sprekk::fracture_flow
