// Chooses the cells that are removed for a path: the cavity.
#pragma once

#include <vector>

#include "framework/mesh/mesh.hpp"
#include "framework/mesh/plane/planar.hpp"

namespace sprekk {

/// The cell across local face k, also across a fracture; none on the outer boundary.
int cell_across(const Mesh& mesh, int cell, int k);

/// Marks the cells that are removed for paths. The walls of fractures count as closed; `merged` has the nodes of the
/// closed mesh (see to_raw_mesh). For each path these are cells whose centre is within the radius (m) of a segment,
/// cells that a segment meets, and all cells around the nodes of the latter. Then further cells join the cavity: cells
/// with at most one face that does not border on the cavity, cells without a neighbour outside of the cavity, and cells
/// around a node where the cavity would touch itself.
std::vector<bool> choose_cavity(const Mesh& mesh, const std::vector<int>& merged,
                                const std::vector<std::vector<Segment>>& paths, const std::vector<double>& radii);

/// For each cell the number of its connected part of marked cells; none for cells without mark. Parts are ordered by
/// their lowest cell.
std::vector<int> connected_parts(const Mesh& mesh, const std::vector<bool>& is_marked);

/// Whether a segment has a point in common with a cell.
bool meets_cell(const Mesh& mesh, int cell, const Segment& segment);

}  // namespace sprekk
