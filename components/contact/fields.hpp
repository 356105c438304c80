// The fields of the contact.
#pragma once

#include "framework/scene/component.hpp"

namespace sprekk::contact {

/// f, Pa, (normal, tangential) of each fracture cell.
Field& add_traction(const ComponentContext& context);
/// [u], m, (normal, tangential) of each fracture cell.
Field& add_jump(const ComponentContext& context);
/// q, m, of each fracture cell.
Field& add_path(const ComponentContext& context);

}  // namespace sprekk::contact
