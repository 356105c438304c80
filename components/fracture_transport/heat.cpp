// fracture_heat/tpfa: heat in fractures, conducted by two points.
#include "components/capabilities/temperature.hpp"
#include "components/capabilities/usual_ranges.hpp"
#include "components/fracture_transport/fracture_transport.hpp"
#include "framework/scene/registry.hpp"

namespace sprekk::fracture_transport {
namespace {

struct HeatOptions : Options {
  Spec spec() {
    Spec spec("fracture_heat/tpfa", "Heat in fractures: conduction along piecewise linear fractures by two points.");
    spec.ignore("type");
    spec.data("aperture", aperture,
              {.unit = "m",
               .range = positive(),
               .doc = "Thickness of what stores and conducts heat at the start: the initial aperture of the flow.",
               .required = true,
               .fixed = "what enters later brings its own heat capacity"});
    usually(spec, "aperture", usual_aperture());
    spec.data("conductivity", conductivity,
              {.unit = "W/(m*K)",
               .range = positive(),
               .doc = "Thermal conductivity of what fills the fracture (water: 0.6 W/(m*K)).",
               .required = true,
               .fixed = "the fluxes are discretized once"});
    usually(spec, "conductivity", usual_conductivity());
    spec.data("heat_capacity", capacity,
              {.unit = "J/(m^3*K)",
               .range = positive(),
               .doc = "Heat capacity per volume of what fills the fracture (water: 4.2e6 J/(m^3*K)).",
               .required = true,
               .fixed = "heat is counted by changes of the temperature"});
    usually(spec, "heat_capacity", usual_fluid_heat_capacity());
    spec.data("initial_temperature", initial_value,
              {.unit = "K", .doc = "Temperature at the start.", .fixed = "it is what the run starts from"});
    declare_sides(spec, *this, carried_heat);
    crossings.declare(spec, "conductivity",
                      {.unit = "W/(m*K)",
                       .range = positive(),
                       .doc = "Thermal conductivity of what fills the crossing; by default the harmonic mean of those "
                              "of the fractures that meet."});
    return spec;
  }
};

/// Heat in fractures.
class FractureHeat : public FractureTransport, public FractureTemperature {
 public:
  FractureHeat(const ComponentContext& context, const HeatOptions& options)
      : FractureTransport(context, carried_heat, options) {}
};

const RegisterComponent<FractureHeat, HeatOptions> heat("fracture_heat/tpfa");

}  // namespace
}  // namespace sprekk::fracture_transport
