// Quadratic triangles around cracks, with a rosette of quarter-point elements at every tip.
#pragma once

#include <array>
#include <functional>
#include <memory>
#include <vector>

#include "components/fine_fracture/fine_level/geometry.hpp"
#include "components/fine_fracture/quarter_point/mesh/moved_mesh.hpp"
#include "components/fine_fracture/quarter_point/mesh/room.hpp"

namespace sprekk::fine_fracture {

/// Sizes of the mesh of a fine level.
struct FineMeshOptions {
  double tip_size;       ///< radius of the rosettes, m; smaller where there is no room, see TipRoom
  double far_size;       ///< largest edge length, m
  double growth = 0.4;   ///< by how many m the edge length may grow per m of distance
  int sectors = 16;      ///< quarter-point elements per rosette, even
  double kink_size = 0;  ///< edge length at kinks of a path, where the kind of its walls changes, and where cracks
                         ///< meet, m; 0: a quarter of the tip size
  /// A further bound of the edge length (m) as a function of place; may be empty.
  std::function<double(const Point&)> size_limit = {};
};

/// Numbers of three nodes: from, to, middle (or quarter).
using EdgeNodes = std::array<int, 3>;

/// The mesh of a fine level.
struct FineMesh {
  /// Corner nodes 0, 1, 2 counter-clockwise, then the nodes on the edges 01, 12, 20. A quarter-point element has the
  /// tip as its node 0 and the nodes on the edges 01 and 20 a quarter of their length away from it (Barsoum 1976).
  struct Element {
    std::array<int, 6> nodes;
    int tip;  ///< index into tips, or none
  };
  /// An edge of an element on the outline of the domain.
  struct OutlineEdge {
    EdgeNodes nodes;
    int element;
    int edge;  ///< of the outline
  };
  /// A pair of edges of elements on the two walls of a crack.
  struct WallEdge {
    int crack;
    std::array<EdgeNodes, 2> nodes;  ///< by Wall, along the path
    std::array<int, 2> elements;     ///< by Wall
    Point tangent, normal;           ///< unit; along the path, and from plus to minus
    double from, to;                 ///< arc length along the path, m
    CrackPath::Walls walls;
    int tip;  ///< whose rosette the edge belongs to, or none
  };
  /// A tip and its rosette.
  struct Tip {
    TipRoom room;
    int node;
    /// The nodes on the walls of the rosette: [upper or lower][at a quarter of the radius, at the radius]. Upper is
    /// where x2 > 0 in the frame of the tip: x1 is its direction, x2 is x1 turned by +90 degrees.
    std::array<std::array<int, 2>, 2> wall_nodes;
  };

  std::vector<Point> nodes;  ///< corners first
  int corner_count = 0;
  std::vector<Element> elements;
  std::vector<OutlineEdge> outline_edges;
  std::vector<WallEdge> wall_edges;
  std::vector<Tip> tips;
  std::vector<std::vector<double>> arc_lengths;  ///< of the points of every crack, m

  int node_count() const { return static_cast<int>(nodes.size()); }
};

/// Keeps a triangulation, so that meshes depend continuously on the geometry.
struct TriangulationKeeper {
  Point anchor = Point::Zero();              ///< m, a place that stays while cracks grow
  std::shared_ptr<const Triangulated> kept;  ///< of an earlier geometry, or null
};

/// Makes the mesh of a fine level. Throws std::invalid_argument for a geometry or options that are not valid, and
/// std::runtime_error where the mesh cannot follow the lines of the geometry. `keeper`: if not null, the triangulation
/// that it keeps is moved to this geometry where that is possible. Otherwise one is made for the rounded geometry
/// (rounded_geometry), moved, and kept: geometries that differ by round-off have the same topology.
FineMesh make_fine_mesh(const FineGeometry& geometry, const FineMeshOptions& options,
                        TriangulationKeeper* keeper = nullptr);

}  // namespace sprekk::fine_fracture
