// What a program is told of the mesh.
#pragma once

#include "framework/mesh/mesh.hpp"
#include "framework/outside/message.hpp"

namespace sprekk::outside {

/// Adds the mesh to the first message: the arrays that docs/outside_program.md lists.
void add_mesh(const Mesh& mesh, OutsideMessage& hello);

}  // namespace sprekk::outside
