// Matrices between faces and walls of fractures.
#pragma once

#include "framework/mesh/mesh.hpp"

namespace sprekk {

/// Takes the values of owned walls from those of faces.
SparseMatrix owned_walls_of_faces(const Mesh& mesh);
/// What enters the rock through each face, by what enters through a wall per m² (in a plane: per m).
SparseMatrix outflow_of_wall_fluxes(const Mesh& mesh);

}  // namespace sprekk
