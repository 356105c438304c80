// Adds a place where fractures meet, and the ridges between the cells that meet there.
#pragma once

#include <vector>

#include "framework/mesh/mesh.hpp"

namespace sprekk {

/// One of FractureCell::ridges of a cell.
struct RidgeOfCell {
  int cell, ridge;
};

/// Adds the junction of the given cells, in ascending order, with a ridge for each pair of them. The ridges between
/// cells of one fracture exist already. `place`: a ridge there, with the place and the measure of the junction.
void add_junction(Mesh& mesh, const Ridge& place, const std::vector<RidgeOfCell>& at);

}  // namespace sprekk
