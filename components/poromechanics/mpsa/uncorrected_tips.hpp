// Tips of fractures around which displacements are taken to be linear, as elsewhere.
#pragma once

#include <vector>

#include "components/poromechanics/mpsa/mpsa.hpp"
#include "framework/discretization/uncorrected_ends.hpp"

namespace sprekk::poromechanics {

/// The tips of fractures whose field (TipField) is missing, or is missing at a node next to the tip. `stiffness`: one a
/// cell, Pa.
UncorrectedEnds uncorrected_tips(const Mesh& mesh, const std::vector<Stiffness>& stiffness);

}  // namespace sprekk::poromechanics
