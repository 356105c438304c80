// What everything that reads a mesh relies on.
#pragma once

#include "framework/mesh/mesh.hpp"

namespace sprekk {

/// In builds with assertions: all lists have their lengths, all indices are in range, faces and cells refer to one
/// another, areas and lengths are positive, normals are unit vectors that point where they should, and walls, ridges
/// and junctions fit together. In other builds nothing.
void expect_sound(const Mesh& mesh);

}  // namespace sprekk
