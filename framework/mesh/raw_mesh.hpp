// A triangulation before it is split along its fractures: what mesh generators and growth write and `build_mesh` reads.
#pragma once

#include <array>
#include <string>
#include <vector>

#include "framework/types.hpp"

namespace sprekk {

/// Node positions are in m. Triangle i becomes cell i of the Mesh; nodes that no triangle uses are dropped.
struct RawMesh {
  struct BoundaryEdge {
    std::array<int, 2> nodes;
    int side;  ///< index into side_names
  };
  /// A fracture is a path of edges that joins its nodes one after the other. Neither end may be repeated (no loops).
  struct Chain {
    std::string name;
    std::vector<int> nodes;
  };

  std::vector<Point> nodes;
  std::vector<std::array<int, 3>> triangles;  ///< either orientation
  std::vector<int> regions;                   ///< one per triangle, index into region_names
  std::vector<std::string> region_names;
  std::vector<BoundaryEdge> boundary_edges;  ///< every edge of the outer boundary, once
  std::vector<std::string> side_names;
  std::vector<Chain> fractures;
};

}  // namespace sprekk
