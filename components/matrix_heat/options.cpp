#include "components/matrix_heat/matrix_heat.hpp"

#include "components/capabilities/usual_ranges.hpp"

namespace sprekk::matrix_heat {
namespace {

Spec side_spec(SideCondition& side) {
  Spec spec("boundary condition of heat", "At most one of the two; none conducts no heat.");
  spec.data("temperature", side.temperature,
            {.unit = "K", .doc = "Temperature on this side, also of fluid that enters there.", .in_time = true});
  spec.data("heat_flux", side.heat_flux,
            {.unit = "W/m^2", .doc = "Heat conducted out of the rock, per area of this side.", .in_time = true});
  spec.check([](const Node& node) {
    if (node.find("temperature") && node.find("heat_flux"))
      throw InputError(node.origin, "contradictory boundary condition at '" + node.path + "'",
                       "a side has either a temperature or a heat flux", "remove one of them");
  });
  return spec;
}

}  // namespace

Spec Options::spec(const std::string& type, const std::string& doc) {
  Spec spec(type, doc);
  spec.ignore("type");
  spec.tensor("conductivity", conductivity,
              {.unit = "W/(m*K)",
               .range = non_negative(),
               .doc = "Thermal conductivity of rock with fluid in its pores; positive definite.",
               .required = true,
               .material = true,
               .fixed = "the fluxes are discretized once"});
  usually(spec, "conductivity", usual_conductivity());
  spec.data("heat_capacity", heat_capacity,
            {.unit = "J/(m^3*K)",
             .range = positive(),
             .doc = "Heat capacity of rock with fluid in its pores, per volume.",
             .required = true,
             .material = true,
             .fixed = "heat is counted by changes of the temperature"});
  usually(spec, "heat_capacity", usual_heat_capacity());
  spec.data("initial_temperature", initial_temperature,
            {.unit = "K", .doc = "Temperature at the start.", .fixed = "it is what the run starts from"});
  spec.data("source", source,
            {.unit = "W/m^3", .doc = "Heat that the rock makes, per volume and time.", .in_time = true});
  static SideCondition example;
  spec.named_sections("boundary", side_spec(example),
                      [this](const std::string& side, const Origin& origin) {
                        boundary[side].origin = origin;
                        return side_spec(boundary[side]);
                      },
                      {.doc = "Conditions by the name of the side; a side without one is insulated."});
  return spec;
}

}  // namespace sprekk::matrix_heat
