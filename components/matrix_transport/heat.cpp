// matrix_heat/tpfa and matrix_heat/mpfa: heat in the matrix with these approximations of the conducted flux.
#include "components/capabilities/temperature.hpp"
#include "components/capabilities/usual_ranges.hpp"
#include "components/matrix_transport/matrix_transport.hpp"
#include "framework/scene/registry.hpp"

namespace sprekk::matrix_transport {
namespace {

struct Heat {
  using Value = MatrixTemperature;
  using Walls = HeatWalls;
  static const Carried& carried() { return carried_heat; }
};

Spec heat_spec(Options& options, const std::string& type, const std::string& doc) {
  Spec spec(type, doc);
  spec.ignore("type");
  spec.tensor("conductivity", options.conductivity,
              {.unit = "W/(m*K)",
               .range = non_negative(),
               .doc = "Thermal conductivity of rock with fluid in its pores; positive definite.",
               .required = true,
               .material = true,
               .fixed = "the fluxes are discretized once"});
  usually(spec, "conductivity", usual_conductivity());
  spec.data("heat_capacity", options.capacity,
            {.unit = "J/(m^3*K)",
             .range = positive(),
             .doc = "Heat capacity of rock with fluid in its pores, per volume.",
             .required = true,
             .material = true,
             .fixed = "heat is counted by changes of the temperature"});
  usually(spec, "heat_capacity", usual_heat_capacity());
  spec.data("initial_temperature", options.initial_value,
            {.unit = "K", .doc = "Temperature at the start.", .fixed = "it is what the run starts from"});
  spec.data("source", options.source,
            {.unit = "W/m^3", .doc = "Heat that the rock makes, per volume and time.", .in_time = true});
  declare_sides(spec, options, carried_heat, "heat_flux");
  return spec;
}

struct HeatTpfaOptions : Options {
  Spec spec() {
    return heat_spec(*this, "matrix_heat/tpfa",
                     "Heat in the matrix: two-point flux approximation, monotone; consistent on orthogonal meshes "
                     "only.");
  }
};

struct HeatMpfaOptions : Options {
  Spec spec() {
    return heat_spec(*this, "matrix_heat/mpfa",
                     "Heat in the matrix: multi-point flux approximation, exact for linear temperatures on any "
                     "mesh.");
  }
};

const RegisterComponent<TransportOf<Heat, two_point>, HeatTpfaOptions> heat_tpfa("matrix_heat/tpfa");
const RegisterComponent<TransportOf<Heat, multi_point>, HeatMpfaOptions> heat_mpfa("matrix_heat/mpfa");

}  // namespace
}  // namespace sprekk::matrix_transport
