// By how much the initial stress, the weight and the loads on sides are out of balance.
#pragma once

#include <string>

#include "components/poromechanics/options.hpp"
#include "framework/assembly/notes.hpp"
#include "framework/mesh/mesh.hpp"

namespace sprekk::poromechanics {

/// Notes rock whose stress or weight is out of balance at the start by more than a hundredth of the largest stress:
/// - on sides, what they give less the initial stress, in directions that may move;
/// - between regions, the difference of their initial stresses;
/// - inside, the force per volume b + div sigma_0, times the extent of the rock in its direction, over which the stress
///   adds up.
/// Loads alone, on rock without stress and weight, are no imbalance: they are what the scene is about.
void note_start_imbalance(Notes& notes, const Options& options, const Mesh& mesh, const std::string& name, double time);

}  // namespace sprekk::poromechanics
