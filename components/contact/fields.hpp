// The fields of the contact.
#pragma once

#include "framework/scene/component.hpp"

namespace sprekk::contact {

/// Whether friction depends on the slip since the accepted state or on the slip rate. In the first case traction and
/// jump are path dependent in a time scheme of two stages (FieldSpec::is_path_dependent).
enum class Friction { of_path, of_rate };

/// Adds the contact traction f, Pa, (normal, tangential) of each fracture cell.
Field& add_traction(const ComponentContext& context, Friction friction);
/// Adds the jump [u], m, (normal, tangential) of each fracture cell.
Field& add_jump(const ComponentContext& context, Friction friction);
/// Adds the length q of the path of slip, m, of each fracture cell.
Field& add_path(const ComponentContext& context);
/// Adds the state theta of friction, s, of each fracture cell.
Field& add_state(const ComponentContext& context);
/// Adds the slip rate V, m/s, along the tangents of each fracture cell.
Field& add_slip_rate(const ComponentContext& context);
/// Adds the slip of each fracture cell, m, along its tangents, before the current event.
Field& add_slip_before_event(const ComponentContext& context);
/// Adds the size of the shear traction of each fracture cell, Pa, before the current event, or the last one.
Field& add_shear_before_event(const ComponentContext& context);
/// Adds the greatest slip rate of each fracture cell in the current event, m/s.
Field& add_peak_slip_rate(const ComponentContext& context);

}  // namespace sprekk::contact
