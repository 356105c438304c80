// Renumbers nodes and cells so that consecutive numbers are neighbours in space.
#pragma once

#include "framework/mesh/raw_mesh.hpp"

namespace sprekk {

/// Renumbers cells and nodes along Hilbert's curve, so that neighbours lie close together in memory. With the arbitrary
/// numbers of a mesh generator, every loop over a large mesh waits for memory. Nothing else changes. `places`:
/// positions of the nodes (m), of this mesh or of a similar one.
void number_in_space(RawMesh& mesh, const std::vector<Point>& places);

}  // namespace sprekk
