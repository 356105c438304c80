// Renumbers nodes and cells so that consecutive numbers are neighbours in space.
#pragma once

#include "framework/mesh/raw_mesh.hpp"

namespace sprekk {

/// Renumbers cells and nodes along Hilbert's curve, so that neighbours lie close together in memory. Mesh generators
/// number in no such order, and loops over a large mesh then wait for memory. Only the numbers change. `places`:
/// positions of the nodes (m), of this mesh or of a similar one.
void number_in_space(RawMesh& mesh, const std::vector<Point>& places);

}  // namespace sprekk
