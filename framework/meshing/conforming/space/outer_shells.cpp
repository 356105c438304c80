#include "framework/meshing/conforming/space/outer_shells.hpp"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <map>
#include <numbers>

#include "framework/mesh/geometry.hpp"
#include "framework/mesh/mesh.hpp"
#include "framework/mesh/outer_ridges.hpp"
#include "framework/mesh/space/face_triangles.hpp"
#include "framework/round_off.hpp"

namespace sprekk {
namespace {

/// Six times the volume of the tetrahedron with these edges at a corner.
double volume_of(const Point& a, const Point& b, const Point& c) { return a.dot(b.cross(c)); }

}  // namespace

std::vector<OuterShell> outer_shells(const std::vector<Point>& nodes, const FaceTable& faces) {
  std::map<RidgeNodes, std::vector<int>> at_ridge;
  std::vector<char> waits(faces.size(), 0);
  for (int face = 0; face < faces.size(); ++face) {
    if (!faces.is_outer(face)) continue;
    waits[face] = 1;
    for (int k = 0; k < faces.nodes(face).size(); ++k) at_ridge[sorted(ridge_of(faces.nodes(face), k))].push_back(face);
  }
  std::vector<OuterShell> shells;
  for (int start = 0; start < faces.size(); ++start) {
    if (!waits[start]) continue;
    OuterShell shell{{start}};
    waits[start] = 0;
    const Point origin = nodes[faces.nodes(start)[0]];
    for (std::size_t next = 0; next < shell.faces.size(); ++next) {
      const FaceNodes& face = faces.nodes(shell.faces[next]);
      const FaceGeometry geometry = face_geometry(nodes, face);
      shell.volume += geometry.measure * geometry.normal.dot(geometry.center - origin) / 3;
      for (int k = 0; k < face.size(); ++k)
        for (const int other : at_ridge.at(sorted(ridge_of(face, k))))
          if (waits[other]) {
            waits[other] = 0;
            shell.faces.push_back(other);
          }
    }
    shells.push_back(std::move(shell));
  }
  return shells;
}

double cover(const Point& x, const std::vector<int>& outer, const std::vector<Point>& nodes, const FaceTable& faces) {
  // van Oosterom and Strackee (IEEE Trans. Biomed. Eng. 30 (1983) 125).
  double angle = 0;
  for (const int face : outer)
    for_each_triangle(nodes, faces.nodes(face), [&](const Point& p, const Point& q, const Point& r) {
      const Point a = p - x, b = q - x, c = r - x;
      const double la = a.norm(), lb = b.norm(), lc = c.norm();
      angle += 2 * std::atan2(volume_of(a, b, c), la * lb * lc + a.dot(b) * lc + a.dot(c) * lb + b.dot(c) * la);
    });
  return angle / (4 * std::numbers::pi);
}

bool pierces(const Point& from, const Point& to, const FaceNodes& face, const std::vector<Point>& nodes) {
  bool found = false;
  const Point along = to - from;
  for_each_triangle(nodes, face, [&](const Point& a, const Point& b, const Point& c) {
    const Point normal = (b - a).cross(c - a);
    const double start = normal.dot(from - a), end = normal.dot(to - a);
    const double near = rounding::same * normal.norm() * along.norm();
    if (std::min(start, end) > -near || std::max(start, end) < near) return;
    // The line passes on the same side of all edges.
    const double first = volume_of(along, a - from, b - from), second = volume_of(along, b - from, c - from),
                 third = volume_of(along, c - from, a - from);
    found = found || std::min({first, second, third}) >= 0 || std::max({first, second, third}) <= 0;
  });
  return found;
}

}  // namespace sprekk
