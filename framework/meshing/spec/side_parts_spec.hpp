// Parts of the sides of a box, as a scene writes them.
#pragma once

#include "framework/config/spec.hpp"
#include "framework/meshing/geometry.hpp"

namespace sprekk {

/// Declares `sides` of a geometry in space.
void declare_side_parts(Spec& spec, Geometry& geometry);

/// Resolves what the parts leave open once the box is known. Throws InputError for parts that are empty, lie outside of
/// their side, have the name of a side, or overlap.
void complete_side_parts(Geometry& geometry);

}  // namespace sprekk
