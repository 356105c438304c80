// The fields of the contact.
#pragma once

#include "framework/scene/component.hpp"

namespace sprekk::contact {

/// What friction compares with the accepted jump: the path of slip since then, or the rate of slip (FieldSpec).
enum class Friction { of_path, of_rate };

/// f, Pa, (normal, tangential) of each fracture cell.
Field& add_traction(const ComponentContext& context, Friction friction);
/// [u], m, (normal, tangential) of each fracture cell.
Field& add_jump(const ComponentContext& context, Friction friction);
/// q, m, of each fracture cell.
Field& add_path(const ComponentContext& context);
/// theta, s, of each fracture cell.
Field& add_state(const ComponentContext& context);
/// V, m/s, along the tangents of each fracture cell.
Field& add_slip_rate(const ComponentContext& context);
/// m, the slip of each fracture cell, along its tangents, before the event that goes on.
Field& add_slip_before_event(const ComponentContext& context);
/// m/s, the greatest slip rate of each fracture cell in the event that goes on.
Field& add_peak_slip_rate(const ComponentContext& context);

}  // namespace sprekk::contact
