#include "couplers/advection/options.hpp"

#include "components/capabilities/concentration.hpp"
#include "components/capabilities/temperature.hpp"
#include "components/capabilities/usual_ranges.hpp"

namespace sprekk::couplers {

void AdvectionOptions::declare_injected(Spec& spec, const Carried& carried) {
  static Injected example;
  const auto injected_spec = [&carried](Injected& at) {
    Spec inner("injected fluid", "The fluid that a well, an injection or a prescribed pressure lets in.");
    inner.data(carried.value, at.value,
               {.unit = carried.unit,
                .range = carried.range,
                .doc = "Its " + carried.value + ".",
                .required = true,
                .in_time = true});
    return inner;
  };
  spec.named_sections(
      "injected", injected_spec(example),
      [this, injected_spec](const std::string& key, const Origin& origin) {
        injected[key].origin = origin;
        return injected_spec(injected[key]);
      },
      {.doc = capitalized(carried.value) + "s by the name of the place in the flow; fluid without one " +
              (carried.of_unknown_fluid ? "has no " + carried.quantity + "."
                                        : "enters with the " + carried.value + " of the cell.")});
}

void AdvectionOptions::declare_scheme(Spec& spec, const Carried& carried) {
  spec.choice("scheme", scheme,
              {{"upwind", "that of the cell, of first order: smears fronts by half a cell for each cell on their way"},
               {"limited",
                "linear within the cell, of second order where values are smooth, and never beyond those around; takes "
                "several iterations in each step"}},
              {.doc = capitalized(carried.value) + " of the fluid where it passes from one cell to the next."});
}

Spec HeatAdvectionOptions::spec() {
  Spec spec("heat_advection",
            "Flowing fluid carries heat, with the temperature of where it comes from: through the "
            "matrix, along fractures and through their walls, where the coupler stands between flow and heat.");
  spec.ignore("type").ignore("between");
  spec.quantity("fluid_heat_capacity", per_volume,
                {.unit = "J/(m^3*K)",
                 .range = positive(),
                 .doc = "Heat capacity of the fluid per volume (water: 4.2e6 J/(m^3*K)).",
                 .required = true,
                 .material = true});
  usually(spec, "fluid_heat_capacity", usual_fluid_heat_capacity());
  declare_scheme(spec, carried_heat);
  declare_injected(spec, carried_heat);
  return spec;
}

Spec TracerAdvectionOptions::spec() {
  Spec spec("tracer_advection",
            "Flowing fluid carries a dissolved tracer, with the concentration of where it comes from: "
            "through the matrix, along fractures and through their walls, where the coupler stands between flow and "
            "tracer.");
  spec.ignore("type").ignore("between");
  spec.quantity("longitudinal_dispersivity", dispersivity.along,
                {.unit = "m",
                 .range = non_negative(),
                 .doc = "Length by which uneven flow spreads the tracer along the flow: times the Darcy velocity it is "
                        "added to the diffusion, as the flow was last solved.",
                 .source = "Scheidegger 1961"});
  spec.quantity(
      "transverse_dispersivity", dispersivity.across,
      {.unit = "m", .range = non_negative(), .doc = "The same across the flow.", .source = "Scheidegger 1961"});
  declare_scheme(spec, carried_tracer);
  declare_injected(spec, carried_tracer);
  return spec;
}

}  // namespace sprekk::couplers
