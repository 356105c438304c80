// matrix_transport/tpfa and matrix_transport/mpfa: a tracer in the matrix with these approximations of diffusion.
#include "components/capabilities/concentration.hpp"
#include "components/capabilities/tracer_options.hpp"
#include "components/capabilities/usual_ranges.hpp"
#include "components/matrix_transport/matrix_transport.hpp"
#include "framework/scene/registry.hpp"

namespace sprekk::matrix_transport {
namespace {

struct Tracer {
  using Value = MatrixConcentration;
  using Walls = TracerWalls;
  static const Carried& carried() { return carried_tracer; }
};

struct TracerOptions : Options {
  TracerOptions() { capacity = 1; }  // without sorption

  Spec tracer_spec(const std::string& type, const std::string& doc) {
    Spec spec(type, doc);
    spec.ignore("type");
    spec.data("porosity", porosity,
              {.unit = "",
               .range = strictly_between(0, 1),
               .doc = "Part of the rock that is pores, whose fluid holds the tracer.",
               .required = true,
               .material = true,
               .fixed = "the tracer is counted by changes of the concentration"});
    usually(spec, "porosity", usual_porosity());
    spec.tensor("diffusion", conductivity,
                {.unit = "m^2/s",
                 .range = non_negative(),
                 .doc = "Coefficient of diffusion in the pores, with their tortuosity: the flux is porosity times it "
                        "times the gradient of the concentration; positive definite.",
                 .required = true,
                 .fixed = "the fluxes are discretized once"});
    usually(spec, "diffusion", usual_diffusion());
    declare_tracer(spec, capacity,
                   "Tracer in the pores and sorbed at their walls (linear, in equilibrium) over that in the pores.",
                   decay, initial_value);
    spec.data("source", source,
              {.unit = "kg/(m^3*s)",
               .doc = "Tracer that comes into the rock without fluid, per volume of rock and time.",
               .in_time = true});
    declare_sides(spec, *this, carried_tracer, "flux");
    return spec;
  }
};

struct TracerTpfaOptions : TracerOptions {
  Spec spec() {
    return tracer_spec("matrix_transport/tpfa",
                       "A dissolved tracer in the matrix: two-point flux approximation of diffusion, monotone; "
                       "consistent on orthogonal meshes only.");
  }
};

struct TracerMpfaOptions : TracerOptions {
  Spec spec() {
    return tracer_spec("matrix_transport/mpfa",
                       "A dissolved tracer in the matrix: multi-point flux approximation of diffusion, exact for "
                       "linear concentrations on any mesh.");
  }
};

const RegisterComponent<TransportOf<Tracer, two_point>, TracerTpfaOptions> tracer_tpfa("matrix_transport/tpfa");
const RegisterComponent<TransportOf<Tracer, multi_point>, TracerMpfaOptions> tracer_mpfa("matrix_transport/mpfa");

}  // namespace
}  // namespace sprekk::matrix_transport
