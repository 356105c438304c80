// A mesh before it is split along its fractures: what mesh generators and growth write and `build_mesh` reads.
#pragma once

#include <string>
#include <type_traits>
#include <vector>

#include "framework/mesh/shapes.hpp"
#include "framework/types.hpp"

namespace sprekk {

/// A mesh with faces that are to become fractures. Node positions are in m. Cell i becomes cell i of the Mesh; nodes
/// that no cell uses are dropped.
struct RawMesh {
  /// A face of the outer boundary, and the side of the domain that it lies on.
  struct BoundaryFace {
    FaceNodes nodes;
    int side;  ///< index into side_names
  };
  /// A fracture in a plane: a path of edges that joins its nodes one after the other, none of them twice (no loops). It
  /// may share nodes inside of the rock, but no edges, with other fractures.
  struct Chain {
    std::string name;
    std::vector<int> nodes;
  };
  /// A fracture in space: faces, at most two of which share an edge. It may share edges inside of the rock, but no
  /// faces, with other fractures. The plus side is that from which the nodes of the first face turn clockwise.
  struct Surface {
    std::string name;
    std::vector<FaceNodes> faces;
  };
  using Fracture = std::conditional_t<dimension == 2, Chain, Surface>;

  std::vector<Point> nodes;
  std::vector<CellNodes> cells;  ///< corners, in the order of the shape or mirrored; quadrilaterals are convex
  std::vector<int> regions;      ///< one per cell, index into region_names
  std::vector<std::string> region_names;
  std::vector<BoundaryFace> boundary_faces;  ///< every face of the outer boundary, once
  std::vector<std::string> side_names;
  std::vector<Fracture> fractures;
};

/// The faces of a fracture, each with its plus side on the same side: in a plane along the chain, to whose left it is;
/// in space out of the cell on the plus side, from which the nodes turn clockwise.
/// Throws InputError for a fracture without faces and for one that names a node that does not exist.
std::vector<FaceNodes> faces_of(const RawMesh& raw, const RawMesh::Fracture& fracture);

/// The reverse; in a plane each face begins where the one before it ends.
RawMesh::Fracture fracture_with(const std::string& name, const std::vector<FaceNodes>& faces);

}  // namespace sprekk
