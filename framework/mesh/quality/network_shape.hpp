// Angles between the fractures of a mesh, and the parts of the matrix that they enclose.
#pragma once

#include <optional>
#include <vector>

#include "framework/mesh/mesh.hpp"

namespace sprekk {

/// Two fractures that meet.
struct FractureAngle {
  int one, other;  ///< indices into Mesh::fractures; equal where a fracture has a bend at the place
  double angle;    ///< rad, of the smallest sector between them there
  Point at;        ///< m
};

/// The smallest sector between two fracture cells at each junction.
std::vector<FractureAngle> angles_of_junctions(const Mesh& mesh);

/// A part of the matrix that fractures cut off from all sides of the domain.
struct Pocket {
  int cells;
  double measure;              ///< m^2 (m^3 in space)
  Point center;                ///< m
  std::vector<int> fractures;  ///< the fractures around the part: indices into Mesh::fractures, in ascending order
};

/// All pockets, the one with the fewest cells first.
std::vector<Pocket> pockets(const Mesh& mesh);

}  // namespace sprekk
