// Numbers of nodes and cells that follow one another in space.
#pragma once

#include "framework/mesh/raw_mesh.hpp"

namespace sprekk {

/// Numbers cells and nodes anew along Hilbert's curve, so that neighbours lie close together in memory: mesh generators
/// number them as they please, and every loop over a large mesh with their numbers waits for memory. Nothing else
/// changes. `places`: where the nodes are taken to be, those of the mesh or of one like it.
void number_in_space(RawMesh& mesh, const std::vector<Point>& places);

}  // namespace sprekk
