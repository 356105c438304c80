// The radius at which the pressure around a point of a fracture in space is that of its cells.
#pragma once

#include <utility>
#include <vector>

#include "components/fracture_flow/tpfa/mimetic_drops.hpp"
#include "framework/mesh/mesh.hpp"

namespace sprekk::fracture_flow {

/// The radius r_e (m) at which a rate q at the point `at` of a surface without end has the pressure p_e of the cells
/// there: with the transmissivity T and the distance r,
///   p = -mu q/(2 pi T) ln r,   sum of share · p_cell = -mu q/(2 pi T) ln r_e.
/// Peaceman's radius (SPE Journal 18 (1978) 183; 23 (1983) 531), found as he found it: the equations of the flow are
/// solved in the cells around `cell`, which holds the point, with this pressure at the edges of that patch. So it is
/// right for cells of any shape. `shares`: of these cells in q. 0 where the cell is at a rim or a crossing.
double equivalent_radius(const Mesh& mesh, const MimeticDrops& drops, int cell, const Point& at,
                         const std::vector<std::pair<int, double>>& shares);

}  // namespace sprekk::fracture_flow
