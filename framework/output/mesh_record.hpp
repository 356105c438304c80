// The mesh inside a checkpoint.
#pragma once

#include "framework/mesh/mesh.hpp"
#include "framework/output/hdf5_file.hpp"

namespace sprekk {

/// Writes every array of the mesh below "mesh/". A mesh that has grown cannot be generated from the scene again.
/// Derived arrays are stored too, so that a restarted run goes on with the same bits.
void write_mesh(Hdf5Writer& file, const Mesh& mesh);

/// Reads a mesh that `write_mesh` wrote; the mesh gets a new version. Throws Hdf5Error if arrays are missing or their
/// sizes contradict one another.
Mesh read_mesh(const Hdf5Reader& file);

/// Whether both meshes have the same nodes (to the bit), cells and fracture cells, so that values on one are values on
/// the other.
bool is_same_mesh(const Mesh& a, const Mesh& b);

}  // namespace sprekk
