#include "components/matrix_transport/matrix_transport.hpp"

namespace sprekk::matrix_transport {
namespace {

Spec side_spec(SideCondition& side, const Carried& carried, const std::string& flux_key) {
  Spec spec("boundary condition of " + carried.quantity,
            "At most one of the two; none conducts no " + carried.quantity + ".");
  spec.data(carried.value, side.value,
            {.unit = carried.unit,
             .range = carried.range,
             .doc = capitalized(carried.value) + " on this side, also of fluid that enters there.",
             .in_time = true});
  spec.data(flux_key, side.flux,
            {.unit = carried.flux_unit,
             .doc = capitalized(carried.quantity) + " conducted out of the rock, per area of this side.",
             .in_time = true});
  spec.check([&carried, flux_key](const Node& node) {
    if (node.find(carried.value) && node.find(flux_key))
      throw InputError(node.origin, "contradictory boundary condition at '" + node.path + "'",
                       "a side has either a " + carried.value + " or a " + flux_key, "remove one of them");
  });
  return spec;
}

}  // namespace

void declare_sides(Spec& spec, Options& options, const Carried& carried, const std::string& flux_key) {
  static SideCondition example;
  spec.named_sections("boundary", side_spec(example, carried, flux_key),
                      [&options, &carried, flux_key](const std::string& side, const Origin& origin) {
                        options.boundary[side].origin = origin;
                        return side_spec(options.boundary[side], carried, flux_key);
                      },
                      {.doc = "Conditions by the name of the side; a side without one is insulated."});
}

}  // namespace sprekk::matrix_transport
