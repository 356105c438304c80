#include "framework/mesh/ridge_distance.hpp"

namespace sprekk {

double distance_to_ridge(const Mesh& mesh, int cell, int /*ridge*/) { return 0.5 * mesh.fracture_cells[cell].measure; }

}  // namespace sprekk
