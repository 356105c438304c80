// A plane mesh before it is split along its fractures: what mesh generators and growth write and `build_mesh` reads.
#pragma once

#include <array>
#include <string>
#include <vector>

#include "framework/mesh/ring.hpp"
#include "framework/types.hpp"

namespace sprekk {

/// A plane mesh with chains of edges that are to become fractures. Node positions are in m. Cell i becomes cell i of
/// the Mesh; nodes that no cell uses are dropped.
struct RawMesh {
  /// An edge of the outer boundary, and the side of the domain that it lies on.
  struct BoundaryEdge {
    std::array<int, 2> nodes;
    int side;  ///< index into side_names
  };
  /// A fracture is a path of edges that joins its nodes one after the other, none of them twice (no loops). It may
  /// share nodes inside of the rock, but no edges, with other fractures.
  struct Chain {
    std::string name;
    std::vector<int> nodes;
  };

  std::vector<Point> nodes;
  std::vector<Ring> cells;   ///< corners of triangles and convex quadrilaterals, either orientation
  std::vector<int> regions;  ///< one per cell, index into region_names
  std::vector<std::string> region_names;
  std::vector<BoundaryEdge> boundary_edges;  ///< every edge of the outer boundary, once
  std::vector<std::string> side_names;
  std::vector<Chain> fractures;
};

}  // namespace sprekk
