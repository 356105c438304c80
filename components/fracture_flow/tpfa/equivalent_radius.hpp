// The radius at which the pressure around a rate at a point of a fracture in space equals that of its cells.
#pragma once

#include <utility>
#include <vector>

#include "components/fracture_flow/tpfa/mimetic_drops.hpp"
#include "framework/mesh/mesh.hpp"

namespace sprekk::fracture_flow {

/// The radius r_e (m) at which the pressure of a rate q at the point `at` of an infinite surface equals the mean of the
/// cells at the point: with the transmissivity T and the distance r,
///   p = -mu q/(2 pi T) ln r,   sum of share · p_cell = -mu q/(2 pi T) ln r_e.
/// Peaceman's radius (SPE Journal 18 (1978) 183; 23 (1983) 531), found by his method: the equations of the flow are
/// solved in a patch of cells around `cell`, which contains the point, with the pressure above at the edges of the
/// patch. So r_e is right for cells of any shape. `shares`: the share of each cell in q. Returns 0 where the cell is at
/// a rim or a crossing.
double equivalent_radius(const Mesh& mesh, const MimeticDrops& drops, int cell, const Point& at,
                         const std::vector<std::pair<int, double>>& shares);

}  // namespace sprekk::fracture_flow
