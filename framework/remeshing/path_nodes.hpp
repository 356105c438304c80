// The nodes along new paths.
#pragma once

#include <map>
#include <vector>

#include "framework/mesh/mesh.hpp"
#include "framework/mesh/raw_mesh.hpp"
#include "framework/remeshing/extension_check.hpp"

namespace sprekk {

/// Places of nodes are in `nodes`; what raw mesh nodes there are comes first.
struct PathNodes {
  std::vector<Point> nodes;
  std::vector<std::vector<int>> paths;  ///< per extension, from the old tip (a raw node) to the new end
  /// Faces between regions and on the outer boundary that get further nodes, in no order.
  std::map<int, std::vector<int>> on_face;
  /// Places along paths where a narrow gap asks for shorter edges, m.
  struct Narrow {
    Point position;
    double size;
  };
  std::vector<Narrow> narrow;
};

/// An interface between regions and a path that come nearer to each other than this, in edge lengths, meet in a node.
inline constexpr double interface_snap = 0.1;

/// Divides paths into edges of about `size`, each segment into one or more; where the outer boundary or another
/// fracture is nearer than `gap_edges` times that, into shorter ones that fit between (no shorter than the cells of the
/// other fracture, which stay). Where a path crosses an interface between regions both get a node. A path bends by up
/// to interface_snap to pass through a node of an interface, and a point of the path this near to an interface moves
/// onto it; interfaces stay as they are. An end on the outer boundary becomes a node of that, one at a point of another
/// fracture is its node. `merged` is that of to_raw_mesh. The extensions have been checked.
PathNodes place_path_nodes(const Mesh& mesh, const RawMesh& raw, const std::vector<int>& merged,
                           const std::vector<PathExtension>& extensions, double size, double gap_edges);

}  // namespace sprekk
