// By how much the initial stress, the weight and the loads on sides are out of balance.
#pragma once

#include <string>

#include "components/poromechanics/options.hpp"
#include "framework/assembly/notes.hpp"
#include "framework/mesh/mesh.hpp"

namespace sprekk::poromechanics {

/// What acts on rock at a place and is balanced by nothing before the rock deforms.
struct Imbalance {
  double stress = 0;         ///< Pa
  Point at = Point::Zero();  ///< where it is largest
  std::string because;       ///< what does not fit what, with figures
};

/// The largest imbalance of the data at a time (s):
/// - on sides, what they give less the initial stress, in directions that may move;
/// - between regions, the difference of their initial stresses;
/// - inside, the force per volume b + div sigma_0, times the extent of the rock in its direction, over which the stress
///   adds up.
Imbalance start_imbalance(const Options& options, const Mesh& mesh, double time);

/// Notes rock whose stress or weight is out of balance at the start by more than a hundredth of the largest stress.
/// Loads alone, on rock without stress and weight, are no imbalance: they are what the scene is about.
void note_start_imbalance(Notes& notes, const Options& options, const Mesh& mesh, const std::string& name, double time);

}  // namespace sprekk::poromechanics
