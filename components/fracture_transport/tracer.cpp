// fracture_transport/tpfa: a tracer in fractures, which diffuses by two points.
#include "components/capabilities/concentration.hpp"
#include "components/capabilities/tracer_options.hpp"
#include "components/capabilities/usual_ranges.hpp"
#include "components/fracture_transport/fracture_transport.hpp"
#include "framework/scene/registry.hpp"

namespace sprekk::fracture_transport {
namespace {

struct TracerOptions : Options {
  TracerOptions() { capacity = 1; }  // without sorption

  Spec spec() {
    Spec spec("fracture_transport/tpfa",
              "A dissolved tracer in fractures: diffusion along piecewise linear fractures by two points.");
    spec.ignore("type");
    spec.data("aperture", aperture,
              {.unit = "m",
               .range = positive(),
               .doc = "Thickness of the fluid that holds the tracer at the start: the initial aperture of the flow.",
               .required = true,
               .fixed = "what enters later brings its own tracer"});
    usually(spec, "aperture", usual_aperture());
    spec.data("diffusion", conductivity,
              {.unit = "m^2/s",
               .range = positive(),
               .doc = "Coefficient of diffusion in what fills the fracture (ions in water: 1e-9 m^2/s).",
               .required = true,
               .fixed = "the fluxes are discretized once"});
    usually(spec, "diffusion", usual_diffusion());
    declare_tracer(spec, capacity,
                   "Tracer in the fluid and sorbed at the walls (linear, in equilibrium) over that in the fluid.",
                   decay, initial_value);
    declare_sides(spec, *this, carried_tracer);
    crossings.declare(spec, "diffusion",
                      {.unit = "m^2/s",
                       .range = positive(),
                       .doc = "Coefficient of diffusion in what fills the crossing; by default the harmonic mean of "
                              "those of the fractures that meet."});
    return spec;
  }
};

/// A tracer in fractures.
class FractureTracer : public FractureTransport, public FractureConcentration {
 public:
  FractureTracer(const ComponentContext& context, const TracerOptions& options)
      : FractureTransport(context, carried_tracer, options) {}
};

const RegisterComponent<FractureTracer, TracerOptions> tracer("fracture_transport/tpfa");

}  // namespace
}  // namespace sprekk::fracture_transport
