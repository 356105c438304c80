// Faces that end at tips of fractures.
#pragma once

#include <vector>

#include "framework/mesh/mesh.hpp"

namespace sprekk::poromechanics {

/// For each face the tip (a node) at one of its ends, or none. Cells of second order have the middle node of such a
/// face a quarter of the face away from the tip: along rays from the tip displacements then have a part like the square
/// root of the distance, and strains one like its inverse (Barsoum 1976; Henshell and Shaw 1975). In space all are
/// none.
std::vector<int> tips_of_faces(const Mesh& mesh);

/// Whether a face of the cell ends at a tip.
bool is_at_tip(const Mesh& mesh, const std::vector<int>& tips, int cell);

/// For each face of the cells at a tip the number of its group, which the faces around one tip share (and those around
/// two tips with a cell in common); none for all others.
std::vector<int> groups_at_tips(const Mesh& mesh, const std::vector<int>& tips);

}  // namespace sprekk::poromechanics
