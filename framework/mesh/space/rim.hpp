// The rims of fractures: where they end in the rock.
#pragma once

#include <array>
#include <vector>

#include "framework/mesh/mesh.hpp"

namespace sprekk {

/// An edge at which a fracture ends in the rock.
struct RimEdge {
  std::array<int, 2> nodes;
  int cell;     ///< the fracture cell that ends here
  Tensor axes;  ///< see EndFrame::axes; to the left is the plus side
};

/// The edge at a ridge, with the frame of its first cell as if that ended there.
RimEdge rim_edge(const Mesh& mesh, int ridge);

/// The edges of rims at a node, at most two for each fracture.
std::vector<RimEdge> rim_at(const Mesh& mesh, int node);

/// The nodes of all rims.
std::vector<char> nodes_of_rims(const Mesh& mesh);

}  // namespace sprekk
