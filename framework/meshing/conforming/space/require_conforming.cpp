#include "framework/meshing/conforming/require_conforming.hpp"

#include <fmt/format.h>

#include <Eigen/Geometry>
#include <algorithm>

#include "framework/config/input_error.hpp"
#include "framework/mesh/geometry.hpp"
#include "framework/meshing/conforming/space/outer_shells.hpp"
#include "framework/round_off.hpp"

namespace sprekk {
namespace {

/// Faces of a hole from which some ten tetrahedra are missing. A hole that is meant has more, or has a group.
constexpr std::size_t few_faces = 24;

/// Whether x lies on a face, off its corners.
bool lies_on(const Point& x, const FaceNodes& face, const std::vector<Point>& nodes) {
  const FaceGeometry geometry = face_geometry(nodes, face);
  double longest = 0;
  for (int k = 0; k < face.size(); ++k) longest = std::max(longest, (nodes[face.after(k)] - nodes[face[k]]).norm());
  const double near = rounding::same * longest;
  if (std::abs((x - geometry.center).dot(geometry.normal)) > near) return false;
  for (int k = 0; k < face.size(); ++k) {
    const Point &from = nodes[face[k]], &to = nodes[face.after(k)];
    if (geometry.normal.dot((to - from).cross(x - from)) < -near * (to - from).norm()) return false;
  }
  return true;
}

/// Outer faces, with the boxes around them, by their lowest x.
struct Outer {
  int face;
  Point low, high;
};

/// Throws InputError if edges of outer faces pass through outer faces, or a body lies in another one.
void require_apart(const RawMesh& mesh, const FaceTable& faces, const std::vector<Outer>& outer, double widest,
                   const std::vector<OuterShell>& shells) {
  std::vector<Point> places;
  const auto has = [](const FaceNodes& face, int node) {
    return std::find(face.begin(), face.end(), node) != face.end();
  };
  for (const Outer& one : outer) {
    const FaceNodes& nodes = faces.nodes(one.face);
    for (int k = 0; k < nodes.size(); ++k) {
      const int first = nodes[k], last = nodes.after(k);
      if (first > last) continue;  // the other face at this edge has it the other way
      const Point &from = mesh.nodes[first], &to = mesh.nodes[last], low = from.cwiseMin(to), high = from.cwiseMax(to);
      auto item = std::ranges::lower_bound(outer, low.x() - widest, {}, [](const Outer& any) { return any.low.x(); });
      for (; item != outer.end() && item->low.x() <= high.x(); ++item) {
        const FaceNodes& face = faces.nodes(item->face);
        if ((high.array() < item->low.array()).any() || (low.array() > item->high.array()).any() || has(face, first) ||
            has(face, last) || !pierces(from, to, face, mesh.nodes))
          continue;
        places.push_back(0.5 * (from + to));
        break;
      }
    }
  }
  const auto largest = std::ranges::max_element(shells, {}, &OuterShell::volume);
  for (auto shell = shells.begin(); shell != shells.end(); ++shell) {
    if (shell == largest || shell->volume <= 0) continue;
    const Point& x = mesh.nodes[faces.nodes(shell->faces[0])[0]];
    double count = 0;
    for (auto other = shells.begin(); other != shells.end(); ++other)
      if (other != shell) count += cover(x, other->faces, mesh.nodes, faces);
    if (count > 0.5) places.push_back(x);
  }
  if (!places.empty())
    throw InputError(
        fmt::format("its cells do not fit together: they lie on other cells at {} place{}, as at {}. "
                    "Remove the cells that are too many, or make the parts together, so that they have "
                    "common faces",
                    places.size(), places.size() == 1 ? "" : "s", to_text(places[0])));
}

/// Throws InputError for holes from which a few cells are missing, and returns a note for each larger one without a
/// group.
std::vector<std::string> note_holes(const RawMesh& mesh, const FaceTable& faces, const std::vector<bool>& has_group,
                                    const std::vector<OuterShell>& shells) {
  std::vector<std::string> notes;
  for (const OuterShell& shell : shells) {
    if (shell.volume >= 0 || std::ranges::any_of(shell.faces, [&](int face) { return has_group[face]; })) continue;
    Point center = Point::Zero();
    for (const int face : shell.faces)
      center += face_geometry(mesh.nodes, faces.nodes(face)).center / static_cast<double>(shell.faces.size());
    if (shell.faces.size() <= few_faces)
      throw InputError(
          fmt::format("cells are missing: a hole of {} faces around {} is in no group. Add the cells, or give the "
                      "faces of a hole that is meant a group of surfaces",
                      shell.faces.size(), to_text(center)));
    notes.push_back(
        fmt::format("the mesh has a hole of {} faces around {} that no group of surfaces names: it belongs "
                    "to the side 'boundary' (no cell covers it) give it a group, to set its conditions",
                    shell.faces.size(), to_text(center)));
  }
  return notes;
}

}  // namespace

std::vector<std::string> require_conforming(const RawMesh& mesh, const FaceTable& faces,
                                            const std::vector<bool>& has_group) {
  // Where cells do not fit together, there are outer faces on which nodes of other ones lie.
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
    const Point margin = Point::Constant(rounding::same * (item.high - item.low).norm());
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
  if (count > 0)
    throw InputError(fmt::format(
        "its cells do not fit together: {} node{} on outer faces of other cells, as at {}; nothing passes from one "
        "cell "
        "to "
        "the other there. Join nodes at one place (gmsh: Mesh > Coherence), and make the parts together, so that they "
        "have common faces; where a fracture is meant, give it one group of surfaces",
        count, count == 1 ? " lies" : "s lie", to_text(at)));
  const std::vector<OuterShell> shells = outer_shells(mesh.nodes, faces);
  require_apart(mesh, faces, outer, widest, shells);
  return note_holes(mesh, faces, has_group, shells);
}

}  // namespace sprekk
