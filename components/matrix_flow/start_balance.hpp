// By how much the initial pressure and the weight of the fluid are out of balance.
#pragma once

#include <string>
#include <vector>

#include "components/matrix_flow/matrix_flow.hpp"
#include "framework/assembly/notes.hpp"
#include "framework/mesh/mesh.hpp"

namespace sprekk::matrix_flow {

/// The fluid of each cell before the first step.
struct FluidAtStart {
  const Mesh& mesh;
  const Options& options;
  const std::vector<char>& inhabited;   ///< one flag a cell, or empty for all
  const std::vector<Tensor>& mobility;  ///< m^2/(Pa s), one a cell
  Vector density;                       ///< kg/m^3, one a cell
  bool density_varies;
  double time;  ///< s
};

/// Adds a note if the initial pressure is not hydrostatic, so that fluid flows at once although nothing is injected.
/// There is no note if the sides prescribe this pressure or just this flow: then the flow is meant. Collective.
void note_start_imbalance(Notes& notes, const FluidAtStart& start, const std::string& name);

}  // namespace sprekk::matrix_flow
