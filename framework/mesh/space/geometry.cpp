#include "framework/mesh/geometry.hpp"

#include <Eigen/Geometry>

#include "framework/mesh/space/face_triangles.hpp"
#include "framework/round_off.hpp"

namespace sprekk {
Measured cell_geometry(const std::vector<Point>& nodes, const CellNodes& cell) {
  // Relative to a corner, so that coordinates far from the origin cost no digits.
  const Point origin = nodes[cell[0]];
  double volume = 0;
  Point moment = Point::Zero();
  for (std::size_t k = 0; k < shape_with(cell.size())->faces.size(); ++k)
    for_each_triangle(nodes, nodes_of_face(cell, static_cast<int>(k)),
                      [&](const Point& a, const Point& b, const Point& c) {
                        const Point u = a - origin, v = b - origin, w = c - origin;
                        const double part = u.dot(v.cross(w)) / 6;
                        volume += part;
                        moment += part / 4 * (u + v + w);
                      });
  return {origin + moment / volume, volume};
}

FaceGeometry face_geometry(const std::vector<Point>& nodes, const FaceNodes& face) {
  Point area = Point::Zero();
  for_each_triangle(nodes, face,
                    [&](const Point& a, const Point& b, const Point& c) { area += 0.5 * (b - a).cross(c - a); });
  const double measure = area.norm();
  const Point normal = area / measure;
  const Point origin = nodes[face[0]];
  Point moment = Point::Zero();
  for_each_triangle(nodes, face, [&](const Point& a, const Point& b, const Point& c) {
    moment += 0.5 * normal.dot((b - a).cross(c - a)) / 3 * ((a - origin) + (b - origin) + (c - origin));
  });
  return {origin + moment / measure, measure, normal};
}

Measured ridge_geometry(const std::vector<Point>& nodes, const RidgeNodes& ridge) {
  const Point &from = nodes[ridge[0]], &to = nodes[ridge[1]];
  return {0.5 * (from + to), (to - from).norm()};
}

Tangents tangents_of(const Point& normal) {
  Tangents tangents;
  const Point strike = Point::UnitZ().cross(normal);
  const Point along_x = Point::UnitX() - normal.x() * normal;
  tangents.col(0) = (strike.norm() > rounding::far_above ? strike : along_x).normalized();
  tangents.col(1) = normal.cross(tangents.col(0));
  return tangents;
}

}  // namespace sprekk
