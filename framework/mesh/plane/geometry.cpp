#include "framework/mesh/geometry.hpp"

#include "framework/mesh/plane/cell_shape.hpp"

namespace sprekk {

Measured cell_geometry(const std::vector<Point>& nodes, const CellNodes& cell) {
  return {centroid(nodes, cell), signed_area(nodes, cell)};
}

FaceGeometry face_geometry(const std::vector<Point>& nodes, const FaceNodes& face) {
  const Point &from = nodes[face[0]], &to = nodes[face[1]];
  const Point along = to - from;
  const double length = along.norm();
  return {0.5 * (from + to), length, Point(along.y(), -along.x()) / length};
}

Measured ridge_geometry(const std::vector<Point>& nodes, const RidgeNodes& ridge) { return {nodes[ridge[0]], 1}; }

Tangents tangents_of(const Point& normal) { return {-normal.y(), normal.x()}; }

}  // namespace sprekk
