// What a user would not expect of a run that is about to begin.
#pragma once

#include "framework/mesh/mesh_quality.hpp"
#include "framework/scene/model.hpp"

namespace sprekk {

/// The notes of the scene and of all parts, and those on the program, the mesh and the processes. `unknowns`: how many
/// the run solves for.
Notes start_notes(const Model& model, const MeshQuality& quality, long unknowns);

}  // namespace sprekk
