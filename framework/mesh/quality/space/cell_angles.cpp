#include "framework/mesh/quality/cell_angles.hpp"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

#include "framework/mesh/geometry.hpp"

namespace sprekk {
namespace {

int shared_nodes(const FaceNodes& one, const FaceNodes& other) {
  return static_cast<int>(std::count_if(
      one.begin(), one.end(), [&](int node) { return std::find(other.begin(), other.end(), node) != other.end(); }));
}

}  // namespace

AngleRange angles(const std::vector<Point>& nodes, const CellNodes& cell) {
  std::vector<FaceNodes> faces;
  for (std::size_t k = 0; k < shape_with(cell.size())->faces.size(); ++k)
    faces.push_back(nodes_of_face(cell, static_cast<int>(k)));
  std::vector<Point> normals;
  for (const FaceNodes& face : faces) normals.push_back(face_geometry(nodes, face).normal);
  AngleRange range{std::numeric_limits<double>::infinity(), 0};
  for (std::size_t a = 0; a < faces.size(); ++a)
    for (std::size_t b = a + 1; b < faces.size(); ++b) {
      if (shared_nodes(faces[a], faces[b]) != 2) continue;
      const double turn = std::atan2(normals[a].cross(normals[b]).norm(), normals[a].dot(normals[b]));
      range.smallest = std::min(range.smallest, std::numbers::pi - turn);
      range.largest = std::max(range.largest, std::numbers::pi - turn);
    }
  return range;
}

}  // namespace sprekk
