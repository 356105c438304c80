#include "framework/meshing/conforming/require_conforming.hpp"

#include <fmt/format.h>

#include <Eigen/Geometry>
#include <algorithm>

#include "framework/config/input_error.hpp"
#include "framework/mesh/geometry.hpp"

namespace sprekk {
namespace {

constexpr double round_off = 1e-9;  // of the longest edge of a face: what is nearer lies on it

/// Whether x lies on a face, off its corners.
bool lies_on(const Point& x, const FaceNodes& face, const std::vector<Point>& nodes) {
  const FaceGeometry geometry = face_geometry(nodes, face);
  double longest = 0;
  for (int k = 0; k < face.size(); ++k) longest = std::max(longest, (nodes[face.after(k)] - nodes[face[k]]).norm());
  const double near = round_off * longest;
  if (std::abs((x - geometry.center).dot(geometry.normal)) > near) return false;
  for (int k = 0; k < face.size(); ++k) {
    const Point &from = nodes[face[k]], &to = nodes[face.after(k)];
    if (geometry.normal.dot((to - from).cross(x - from)) < -near * (to - from).norm()) return false;
  }
  return true;
}

}  // namespace

std::vector<std::string> require_conforming(const RawMesh& mesh, const FaceTable& faces, const std::vector<bool>&) {
  // Where cells do not fit together, there are outer faces on which nodes of other ones lie.
  struct Outer {
    int face;
    Point low, high;
  };
  std::vector<Outer> outer;
  std::vector<char> is_on_outer(mesh.nodes.size(), 0);
  double widest = 0;
  for (int face = 0; face < faces.size(); ++face) {
    if (!faces.is_outer(face)) continue;
    Outer item{face, mesh.nodes[faces.nodes(face)[0]], mesh.nodes[faces.nodes(face)[0]]};
    for (const int node : faces.nodes(face)) {
      is_on_outer[node] = 1;
      item.low = item.low.cwiseMin(mesh.nodes[node]);
      item.high = item.high.cwiseMax(mesh.nodes[node]);
    }
    const Point margin = Point::Constant(round_off * (item.high - item.low).norm());
    item.low -= margin, item.high += margin;
    widest = std::max(widest, item.high.x() - item.low.x());
    outer.push_back(item);
  }
  std::ranges::sort(outer, {}, [](const Outer& item) { return item.low.x(); });
  int count = 0;
  Point at = Point::Zero();
  for (std::size_t node = 0; node < mesh.nodes.size(); ++node) {
    if (!is_on_outer[node]) continue;
    const Point& x = mesh.nodes[node];
    auto item = std::ranges::lower_bound(outer, x.x() - widest, {}, [](const Outer& one) { return one.low.x(); });
    for (; item != outer.end() && item->low.x() <= x.x(); ++item) {
      const FaceNodes& face = faces.nodes(item->face);
      if ((x.array() < item->low.array()).any() || (x.array() > item->high.array()).any() ||
          std::find(face.begin(), face.end(), static_cast<int>(node)) != face.end() || !lies_on(x, face, mesh.nodes))
        continue;
      if (count++ == 0) at = x;
      break;
    }
  }
  if (count == 0) return {};
  throw InputError(fmt::format(
      "its cells do not fit together: {} node{} on outer faces of other cells, as at {}; nothing passes from one cell "
      "to "
      "the other there. Join nodes at one place (gmsh: Mesh > Coherence), and make the parts together, so that they "
      "have common faces; where a fracture is meant, give it one group of surfaces",
      count, count == 1 ? " lies" : "s lie", to_text(at)));
}

}  // namespace sprekk
