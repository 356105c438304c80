// Figures about a mesh for run.json and for tests.
#pragma once

#include <string>

#include "framework/mesh/mesh.hpp"

namespace sprekk {

/// Counts, extents and shapes of a mesh.
struct MeshQuality {
  int cells = 0, faces = 0, nodes = 0, fractures = 0, fracture_cells = 0;
  double measure = 0;                                                     ///< of the rock, m^2 (m^3 in space)
  double fracture_measure = 0;                                            ///< m (m^2 in space)
  double smallest_angle = 0, mean_smallest_angle = 0, largest_angle = 0;  ///< rad (angles()); the mean is over cells
  int flattest_cell = none;                                               ///< the one with the smallest angle
  double smallest_face = 0, mean_face = 0, largest_face = 0;              ///< m (m^2 in space)
  int cells_with_one_neighbour = 0;  ///< all other faces lie on the outer boundary or on walls
};

MeshQuality mesh_quality(const Mesh& mesh);

/// "an angle of 0.029 degrees at (1, 0.9), between fractures 'a' and 'b', which are 1e-05 m apart there": the smallest
/// angle of a cell, its centre, and the fractures that it lies between, if there are two as near as the cell is high.
std::string flatness_text(const Mesh& mesh, int cell);

}  // namespace sprekk
