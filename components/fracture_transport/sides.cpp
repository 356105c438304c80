#include "components/fracture_transport/fracture_transport.hpp"

namespace sprekk::fracture_transport {
namespace {

Spec side_spec(Data& value, const Carried& carried) {
  Spec spec("boundary condition of " + carried.quantity + " in fractures", "For fractures that end on this side.");
  spec.data(carried.value, value,
            {.unit = carried.unit,
             .range = carried.range,
             .doc = capitalized(carried.value) + " where fractures meet this side, also of fluid that enters there.",
             .required = true,
             .in_time = true});
  return spec;
}

}  // namespace

void declare_sides(Spec& spec, Options& options, const Carried& carried) {
  static Data example;
  spec.named_sections(
      "boundary", side_spec(example, carried),
      [&options, &carried](const std::string& side, const Origin& origin) {
        options.boundary_origins[side] = origin;
        return side_spec(options.boundary[side], carried);
      },
      {.doc = capitalized(carried.value) + "s where fractures end on a side; else nothing is conducted there."});
}

}  // namespace sprekk::fracture_transport
