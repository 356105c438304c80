// Notes on large jumps, on jumps of springs between the walls, and on fractures that are open along their whole length.
#pragma once

#include <string>
#include <vector>

#include "framework/assembly/part.hpp"
#include "framework/field/field.hpp"
#include "framework/mesh/mesh.hpp"

namespace sprekk::contact {

/// The state of the contact at the end of a step.
struct JumpsOfStep {
  const Field& traction;             ///< Pa, (normal, tangential) of each fracture cell
  const Field& jump;                 ///< m, the same
  const std::vector<char>& is_open;  ///< of each fracture cell
  const std::vector<char>& slides;   ///< the same
  double large_jump;                 ///< over the length of its fracture
  double slip_at_start;              ///< m, the largest while the state at the start was settled
  /// m/Pa, of the springs along the walls of each cell that a penalty method has; empty for exact conditions.
  const std::vector<double>& springs;
};

/// Adds the notes of the component `name` on the step that is about to be accepted.
void note_jumps(Notes& notes, const std::string& name, const Mesh& mesh, const JumpsOfStep& step);

}  // namespace sprekk::contact
