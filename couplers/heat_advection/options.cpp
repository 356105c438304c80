#include "couplers/heat_advection/options.hpp"

#include "components/capabilities/usual_ranges.hpp"

namespace sprekk::couplers {

Spec HeatAdvectionOptions::spec() {
  Spec spec("heat_advection",
            "Flowing fluid carries heat, with the temperature of the cell that it comes from (upwind): through the "
            "matrix, along fractures and through their walls, where the coupler stands between flow and heat.");
  spec.ignore("type").ignore("between");
  spec.quantity("fluid_heat_capacity", fluid_heat_capacity,
                {.unit = "J/(m^3*K)",
                 .range = positive(),
                 .doc = "Heat capacity of the fluid per volume (water: 4.2e6 J/(m^3*K)).",
                 .required = true,
                 .material = true});
  usually(spec, "fluid_heat_capacity", usual_fluid_heat_capacity());
  static Injected example;
  const auto injected_spec = [](Injected& at) {
    Spec inner("injected fluid", "The fluid that a well, an injection or a prescribed pressure lets in.");
    inner.data("temperature", at.temperature,
               {.unit = "K", .doc = "Its temperature.", .required = true, .in_time = true});
    return inner;
  };
  spec.named_sections("injected", injected_spec(example),
                      [this, injected_spec](const std::string& key, const Origin& origin) {
                        injected[key].origin = origin;
                        return injected_spec(injected[key]);
                      },
                      {.doc = "Temperatures by the name of the place in the flow; fluid without one enters with the "
                              "temperature of the cell."});
  return spec;
}

}  // namespace sprekk::couplers
