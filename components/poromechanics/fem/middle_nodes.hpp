// Where the functions of faces and edges are 1.
#pragma once

#include <vector>

#include "components/poromechanics/fem/cell_edges.hpp"
#include "framework/mesh/mesh.hpp"

namespace sprekk::poromechanics {

/// How far the middle nodes of a cell are from the middles, m, in the order of its functions (CellPoint).
struct MiddleNodes {
  std::vector<Point> of_edges, of_faces;
  /// From where points of integrals lie along rays (reference_points), so that these are exact around tips and rims.
  int start;
};

/// `tips`: see tips_of_faces, may be empty. `edges`: in space, may be null.
MiddleNodes middle_nodes(const Mesh& mesh, int cell, const std::vector<int>& tips, const CellEdges* edges);

}  // namespace sprekk::poromechanics
