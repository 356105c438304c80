// Which cells of a mesh make room for a path.
#pragma once

#include <vector>

#include "framework/mesh/mesh.hpp"
#include "framework/mesh/planar.hpp"

namespace sprekk {

/// The cell across local face k, also across a fracture; none on the outer boundary.
int cell_across(const Mesh& mesh, int cell, int k);

/// Marks the cells that make room for paths (the walls of fractures count as closed; `merged` gives the nodes of
/// the closed mesh, see to_raw_mesh). These are, for each path: cells whose centre is within the radius of a segment;
/// cells that a segment meets, and all around their nodes. Then what remains between is taken in: cells with all
/// sides but one at the cavity, cells with no other neighbours, and those around a node where the cavity would touch
/// itself.
std::vector<bool> choose_cavity(const Mesh& mesh, const std::vector<int>& merged,
                                const std::vector<std::vector<Segment>>& paths, const std::vector<double>& radii);

/// Numbers the connected parts of the marked cells; none for the others. Parts are ordered by their lowest cell.
std::vector<int> connected_parts(const Mesh& mesh, const std::vector<bool>& is_marked);

/// Whether a segment has a point in common with a cell.
bool meets_cell(const Mesh& mesh, int cell, const Segment& segment);

}  // namespace sprekk
