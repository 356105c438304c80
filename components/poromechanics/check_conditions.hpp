// Checks the conditions on the sides of the rock.
#pragma once

#include "components/poromechanics/options.hpp"
#include "framework/config/input_error.hpp"
#include "framework/field/field.hpp"
#include "framework/mesh/mesh.hpp"

namespace sprekk::poromechanics {

/// The condition on the side of a face, or nullptr.
const SideCondition* condition_of(const Options& options, const Mesh& mesh, int face);

/// Throws InputError for sides that do not exist, and when the displacements that are prescribed let the rock move as a
/// rigid body. `displaced`: where the displacements are; those of cells are held by means over faces. `where`: of the
/// component.
void check_conditions(const Options& options, const Mesh& mesh, Location displaced, const Origin& where);

}  // namespace sprekk::poromechanics
