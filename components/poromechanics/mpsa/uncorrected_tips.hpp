// Tips of fractures around which displacements are taken to be linear, as elsewhere.
#pragma once

#include <string>
#include <vector>

#include "components/poromechanics/stiffness.hpp"
#include "framework/assembly/notes.hpp"
#include "framework/mesh/mesh.hpp"

namespace sprekk::poromechanics {

/// Notes how many tips of fractures in the rock `name` lack their field (TipField), or lack it at a node next to the
/// tip, and why. `stiffness`: one a cell, Pa.
void note_uncorrected_tips(Notes& notes, const std::string& name, const Mesh& mesh,
                           const std::vector<Stiffness>& stiffness);

}  // namespace sprekk::poromechanics
