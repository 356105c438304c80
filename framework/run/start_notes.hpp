// Notes on a run that is about to begin.
#pragma once

#include "framework/mesh/quality/mesh_quality.hpp"
#include "framework/scene/model.hpp"

namespace sprekk {

/// The notes of the scene and of all parts, and those on the program, the mesh and the processes. `unknowns`: the
/// number of unknowns of the run.
Notes start_notes(const Model& model, const MeshQuality& quality, long unknowns);

}  // namespace sprekk
