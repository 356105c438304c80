#include "components/contact/laws/rate_and_state_options.hpp"

namespace sprekk::contact {

Spec RateAndStateOptions::spec() {
  Spec spec("rate_and_state",
            "Friction that depends on slip rate and on a state that ages: N a arcsinh(V/(2 V_0) exp((f_0 + b ln(V_0 "
            "theta/L))/a)), with f_0 of `friction`. There is no sticking: walls under shear always creep.");
  spec.data("a", a,
            {.range = positive(),
             .doc = "Direct effect: how friction rises with the logarithm of the slip rate.",
             .source = "Rice and Ben-Zion 1996, Lapusta et al. 2000",
             .required = true});
  spec.data(
      "b", b,
      {.range = non_negative(),
       .doc = "How friction rises with the logarithm of the state. Slip is steady for b < a, and may run away for "
              "b > a.",
       .required = true});
  spec.data("distance", distance,
            {.unit = "m",
             .range = positive(),
             .doc = "Slip L over which the state evolves.",
             .source = "ageing law, d theta/dt = 1 - V theta/L: Dieterich 1979",
             .required = true});
  spec.quantity("reference_rate", reference_rate,
                {.unit = "m/s",
                 .range = positive(),
                 .doc = "Slip rate V_0 at which walls in steady slip have the friction `friction`.",
                 .required = true});
  spec.data(
      "initial_state", initial_state,
      {.unit = "s", .range = positive(), .doc = "State theta at the start. This or `initial_slip_rate` is needed."});
  spec.data("initial_slip_rate", initial_slip_rate,
            {.unit = "m/s",
             .range = positive(),
             .doc = "Slip rate V of steady slip before the start: theta = distance/V at the start."});
  Spec damping("radiation_damping", "What shear waves that leave fast slip take from its traction.");
  damping.quantity("wave_speed", wave_speed,
                   {.unit = "m/s",
                    .range = positive(),
                    .doc = "Speed c of shear waves; walls hold G V/(2 c) more at the slip rate V, with the shear "
                           "modulus G of the rock.",
                    .source = "Rice 1993",
                    .required = true});
  spec.section("radiation_damping", damping,
               {.doc = "What shear waves take from the traction of fast slip. Without it, slip that runs away has no "
                       "limit."},
               &is_damped);
  spec.quantity(
      "state_change", state_change,
      {.range = between(1e-4, 0.5),
       .doc = "Longest time step over the state and over distance/slip rate at its start, so that neither age "
              "nor slip changes the logarithm of the state by more. Slip that accelerates may come to twice "
              "as much, or the step is repeated with a shorter one. The error in time falls with it."});
  spec.quantity("event_slip_rate", event_slip_rate,
                {.unit = "m/s",
                 .range = positive(),
                 .doc = "An event begins when any place slips faster, and ends when none does."});
  spec.check([this](const Node& node) {
    if (!initial_state && !initial_slip_rate)
      throw InputError(node.origin, "the state at the start is missing",
                       "it says how strong the walls are: friction rises by b for each factor e of it",
                       "add initial_slip_rate, for example 1e-9 m/s, or initial_state in s");
    if (initial_state && initial_slip_rate)
      throw InputError(node.origin, "the state at the start is given twice",
                       "initial_slip_rate means initial_state = distance/initial_slip_rate", "remove one of the two");
  });
  return spec;
}

}  // namespace sprekk::contact
