// What a scene gives to the coupler biot.
#pragma once

#include <optional>
#include <string>

#include "framework/config/data.hpp"
#include "framework/config/spec.hpp"

namespace sprekk::couplers {

/// The parameters of biot.
struct BiotOptions {
  Data biot_coefficient;
  double fixed_stress_factor = 1;
  std::string fixed_stress_modulus = "bulk";
  std::optional<double> fixed_stress_value;  ///< 1/Pa
  Origin modulus_origin;
  bool one_way = false;
  Spec spec() {
    Spec spec("biot",
              "Poroelastic coupling of the flow in the matrix and the deformation of the rock (the paper's Eqs. 5-7).");
    spec.ignore("type").ignore("between");
    spec.data("biot_coefficient", biot_coefficient,
              {.range = between(0, 1),
               .doc = "Biot's coefficient alpha.",
               .source = "the paper's Eqs. 6, 7",
               .required = true,
               .material = true,
               .in_time = true});
    spec.quantity("fixed_stress_factor", fixed_stress_factor,
                  {.range = positive(),
                   .doc = "The stabilization fixed_stress of split schemes is this times alpha^2/K, with the modulus "
                          "K of `fixed_stress_modulus`.",
                   .source = "Kim, Tchelepi, Juanes 2011"});
    spec.choice(
        "fixed_stress_modulus", fixed_stress_modulus,
        {{"bulk", "the drained bulk modulus"},
         {"uniaxial", "lambda + 2 G: one pass is enough where the displacement is irrotational"},
         {"optimal",
          dimension == 2
              ? "the harmonic mean of lambda + 2 G and the bulk modulus in the plane, lambda + G: the middle "
                "of what pressures of any shape displace"
              : "the harmonic mean of lambda + 2 G and the bulk modulus: the middle of what pressures of any "
                "shape displace"},
         {"found", dimension == 2
                       ? "between lambda + 2 G and lambda + G, as the volume of the rock has followed the pressure in "
                         "the first passes of each time step"
                       : "between lambda + 2 G and the bulk modulus, as the volume of the rock has followed the "
                         "pressure in the first passes of each time step"}},
        {.doc = "The modulus of the stabilization fixed_stress.",
         .source = "Kim, Tchelepi, Juanes 2011; Storvik, Both, Kumar, Nordbotten, Radu 2019"});
    spec.quantity("fixed_stress_value", fixed_stress_value,
                  {.unit = "1/Pa",
                   .range = positive(),
                   .doc = "The stabilization fixed_stress itself, in the place of factor and modulus."});
    spec.check([this](const Node& node) {
      const Node* modulus = node.find("fixed_stress_modulus");
      modulus_origin = modulus ? modulus->origin : node.origin;
      for (const char* other : {"fixed_stress_factor", "fixed_stress_modulus"})
        if (fixed_stress_value && node.find(other))
          throw InputError(node.find(other)->origin, "'" + std::string(other) + "' has no effect",
                           "'fixed_stress_value' is the whole stabilization", "remove one of them");
    });
    spec.flag(
        "one_way", one_way,
        {.doc = "The pressure loads the rock, and the rock's change of volume stores no fluid: the flow is that in "
                "pores of a volume that stays. A `storage` that has alpha^2/(lambda + 2 G) in it stands for the "
                "volume where rock shortens along one axis under constant loads."});
    return spec;
  }
};

}  // namespace sprekk::couplers
