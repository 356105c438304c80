// The nodes along new paths.
#pragma once

#include <map>
#include <vector>

#include "framework/mesh/mesh.hpp"
#include "framework/mesh/raw_mesh.hpp"
#include "framework/remeshing/extension_check.hpp"

namespace sprekk {

/// The nodes of new paths. `nodes` has the positions of all nodes, m: the nodes of the raw mesh come first.
struct PathNodes {
  std::vector<Point> nodes;
  std::vector<std::vector<int>> paths;  ///< per extension, from the old tip (a raw node) to the new end
  /// For faces between regions and on the outer boundary that are divided: the new nodes on the face, in no order.
  std::map<int, std::vector<int>> on_face;
  /// A place along a path where a narrow gap asks for shorter edges, m.
  struct Narrow {
    Point position;
    double size;
  };
  std::vector<Narrow> narrow;
};

/// A path and an interface between regions that are nearer to each other than this, in edge lengths, meet in a node.
inline constexpr double interface_snap = 0.1;

/// Divides paths into edges of about `size` (m), each segment into one or more (whole_segments: into one). Where the
/// outer boundary or another fracture is nearer than `gap_edges` times `size`, edges are shorter, to fit into the gap,
/// but no shorter than the cells of the other fracture, which stay. Where a path crosses an interface between regions,
/// both get a node. A path bends by up to interface_snap to pass through a node of an interface, and a point of the
/// path that near to an interface moves onto it; interfaces stay as they are. An end on the outer boundary becomes a
/// node of the boundary; an end at a point of another fracture is that fracture's node. `merged` is that of
/// to_raw_mesh. The extensions must have passed check_extensions.
PathNodes place_path_nodes(const Mesh& mesh, const RawMesh& raw, const std::vector<int>& merged,
                           const std::vector<PathExtension>& extensions, double size, double gap_edges);

}  // namespace sprekk
