#include "components/contact/fields.hpp"

namespace sprekk::contact {

Field& add_traction(const ComponentContext& context, Friction friction) {
  return context.fields.add(
      context.mesh, {.owner = context.name,
                     .name = "traction",
                     .location = Location::fracture_cell,
                     .components = dimension,
                     .role = Role::unknown(BlockKind::interface),
                     .unit = "Pa",
                     .doc = "Contact traction on the plus wall, normal and tangential (f of the paper's Eqs. 2-4)",
                     .is_path_dependent = friction == Friction::of_path});
}

Field& add_jump(const ComponentContext& context, Friction friction) {
  return context.fields.add(context.mesh,
                            {.owner = context.name,
                             .name = "jump",
                             .location = Location::fracture_cell,
                             .components = dimension,
                             .role = Role::input(BlockKind::interface),
                             .unit = "m",
                             .doc = "Displacement jump, normal (opening) and tangential (slip) (the paper's Eq. 1)",
                             .needs_coupler = "wall_traction",
                             .is_path_dependent = friction == Friction::of_path});
}

Field& add_path(const ComponentContext& context) {
  return context.fields.add(context.mesh, {.owner = context.name,
                                           .name = "path",
                                           .location = Location::fracture_cell,
                                           .role = Role::derived(),
                                           .unit = "m",
                                           .doc = "Path of slip and opening since the start, forth and back",
                                           .accepted_with = context.name + ".traction",
                                           .is_path_dependent = true});
}

Field& add_state(const ComponentContext& context) {
  return context.fields.add(context.mesh, {.owner = context.name,
                                           .name = "state",
                                           .location = Location::fracture_cell,
                                           .role = Role::derived(),
                                           .unit = "s",
                                           .doc = "State of the walls, theta of the ageing law",
                                           .accepted_with = context.name + ".traction"});
}

Field& add_slip_rate(const ComponentContext& context) {
  return context.fields.add(context.mesh, {.owner = context.name,
                                           .name = "slip_rate",
                                           .location = Location::fracture_cell,
                                           .components = dimension - 1,
                                           .role = Role::derived(),
                                           .unit = "m/s",
                                           .doc = "Slip rate at the end of the last step",
                                           .accepted_with = context.name + ".traction"});
}

Field& add_slip_before_event(const ComponentContext& context) {
  return context.fields.add(context.mesh, {.owner = context.name,
                                           .name = "slip_before_event",
                                           .location = Location::fracture_cell,
                                           .components = dimension - 1,
                                           .role = Role::derived(),
                                           .unit = "m",
                                           .doc = "Slip before the event that goes on; between events, slip"});
}

Field& add_shear_before_event(const ComponentContext& context) {
  return context.fields.add(context.mesh,
                            {.owner = context.name,
                             .name = "shear_before_event",
                             .location = Location::fracture_cell,
                             .role = Role::derived(),
                             .unit = "Pa",
                             .doc = "Shear traction before the event that goes on, or before the last step"});
}

Field& add_peak_slip_rate(const ComponentContext& context) {
  return context.fields.add(context.mesh, {.owner = context.name,
                                           .name = "peak_slip_rate",
                                           .location = Location::fracture_cell,
                                           .role = Role::derived(),
                                           .unit = "m/s",
                                           .doc = "Greatest slip rate in the event that goes on"});
}

}  // namespace sprekk::contact
