#include "framework/meshing/space/outer_sides.hpp"

#include <cmath>

#include "framework/mesh/face_table.hpp"
#include "framework/mesh/geometry.hpp"
#include "framework/round_off.hpp"

namespace sprekk {
namespace {

/// Where a side of the box lies along its axis, m.
double level(const Box& box, int side) { return (side % 2 == 0 ? box.low : box.high)[side / 2]; }

int nearest_side(const Box& box, const Point& x) {
  const auto distance = [&](int side) { return std::abs(x[side / 2] - level(box, side)); };
  int nearest = 0;
  for (int side = 1; side < static_cast<int>(box_sides.size()); ++side)
    if (distance(side) < distance(nearest)) nearest = side;
  return nearest;
}

bool is_within(const SidePart& part, const Point& x) {
  for (int axis = 0; axis < dimension; ++axis)
    if (axis != part.side / 2 && (x[axis] < part.low[axis] || x[axis] > part.high[axis])) return false;
  return true;
}

double area_of(const SidePart& part) {
  double area = 1;
  for (int axis = 0; axis < dimension; ++axis)
    if (axis != part.side / 2) area *= part.high[axis] - part.low[axis];
  return area;
}

/// Gives a face that lies on a part the number of that; `areas`: of the faces of each part, m^2.
int part_or_side(const Geometry& geometry, int side, const FaceGeometry& face, std::vector<double>& areas) {
  for (std::size_t k = 0; k < geometry.side_parts.size(); ++k)
    if (geometry.side_parts[k].side == side && is_within(geometry.side_parts[k], face.center)) {
      areas[k] += face.measure;
      return static_cast<int>(box_sides.size() + k);
    }
  return side;
}

}  // namespace

void take_outer_sides(const Geometry& geometry, RawMesh& mesh) {
  mesh.side_names.assign(box_sides.begin(), box_sides.end());
  for (const SidePart& part : geometry.side_parts) mesh.side_names.push_back(part.name);
  std::vector<double> areas(geometry.side_parts.size(), 0);
  const FaceTable faces(mesh.nodes, mesh.cells);
  for (int face = 0; face < faces.size(); ++face) {
    if (!faces.is_outer(face)) continue;
    const FaceGeometry of_face = face_geometry(mesh.nodes, faces.nodes(face));
    const int side = nearest_side(geometry.box, of_face.center);
    mesh.boundary_faces.push_back({faces.nodes(face), part_or_side(geometry, side, of_face, areas)});
    for (const int node : faces.nodes(face)) mesh.nodes[node][side / 2] = level(geometry.box, side);
  }
  for (std::size_t k = 0; k < areas.size(); ++k) {
    const SidePart& part = geometry.side_parts[k];
    if (std::abs(areas[k] - area_of(part)) > rounding::far_above * area_of(part))
      throw InputError(part.origin, "the mesh does not follow '" + part.name + "'",
                       "its border cuts faces of the side '" + std::string(box_sides[part.side]) + "'",
                       "choose other cells or kind: unstructured");
  }
}

std::vector<Point> corners_of(const SidePart& part, const Box& box) {
  const int axis = part.side / 2, one = (axis + 1) % dimension, other = (axis + 2) % dimension;
  std::vector<Point> corners(4, Point::Constant(level(box, part.side)));
  for (int k = 0; k < 4; ++k) {
    corners[k][one] = (k == 1 || k == 2 ? part.high : part.low)[one];
    corners[k][other] = (k >= 2 ? part.high : part.low)[other];
  }
  return corners;
}

}  // namespace sprekk
