#include "components/poromechanics/fem/face_functions.hpp"

#include <Eigen/Geometry>
#include <algorithm>

#include "components/poromechanics/fem/gauss_points.hpp"

namespace sprekk::poromechanics {

std::vector<FacePoint> face_points(const RawDisplacement& raw, int face) {
  const Mesh& mesh = raw.mesh;
  const bool has_edges = raw.edge_count() > 0;
  const FaceNodes& nodes = mesh.face_nodes[face];
  const Point& origin = mesh.nodes[nodes[0]];
  std::vector<FacePoint> points;
  for (const GaussPoint& first : gauss_points())
    for (const GaussPoint& second : gauss_points()) {
      FacePoint point{origin, first.weight * second.weight, Point::Zero(), {}};
      const double x = first.at, y = nodes.size() == 3 ? (1 - x) * second.at : second.at;
      Point along_x, along_y;
      if (nodes.size() == 3) {
        point.value = {1 - x - y, x, y};
        if (has_edges)
          for (int k = 0; k < 3; ++k) point.value.push_back(4 * point.value[k] * point.value[(k + 1) % 3]);
        point.value.push_back(27 * (1 - x - y) * x * y);
        along_x = mesh.nodes[nodes[1]] - origin;
        along_y = mesh.nodes[nodes[2]] - origin;
        point.weight *= 1 - x;
      } else {
        const double in_x = 4 * x * (1 - x), in_y = 4 * y * (1 - y);
        point.value = {(1 - x) * (1 - y), x * (1 - y), x * y, (1 - x) * y};
        if (has_edges) point.value.insert(point.value.end(), {in_x * (1 - y), x * in_y, in_x * y, (1 - x) * in_y});
        point.value.push_back(in_x * in_y);
        const auto side = [&](int from, int to) { return Point(mesh.nodes[nodes[to]] - mesh.nodes[nodes[from]]); };
        along_x = (1 - y) * side(0, 1) + y * side(3, 2);
        along_y = (1 - x) * side(0, 3) + x * side(1, 2);
      }
      for (int k = 1; k < nodes.size(); ++k) point.x += point.value[k] * (mesh.nodes[nodes[k]] - origin);
      const Point area = along_x.cross(along_y);
      point.weight *= area.norm();
      point.normal = area.normalized();
      points.push_back(std::move(point));
    }
  return points;
}

std::vector<FaceFunction> face_functions(const RawDisplacement& raw, const std::vector<int>& /*tips*/, int face) {
  std::vector<FaceFunction> functions;
  for (const int node : raw.mesh.face_nodes[face]) functions.push_back({raw.of_node(node), 0, Point::Zero()});
  for (const int edge : edges_of_face(raw, face)) functions.push_back({raw.of_edge(edge), 0, Point::Zero()});
  functions.push_back({raw.of_face(face), 0, Point::Zero()});
  double area = 0;
  for (const FacePoint& point : face_points(raw, face)) {
    area += point.weight;
    for (std::size_t k = 0; k < functions.size(); ++k) {
      functions[k].mean += point.weight * point.value[k];
      functions[k].flow += point.weight * point.value[k] * point.normal;
    }
  }
  for (FaceFunction& function : functions) function.mean /= area;
  return functions;
}

Point middle_of_face(const Mesh& mesh, int face) {
  Point sum = Point::Zero();
  for (const int node : mesh.face_nodes[face]) sum += mesh.nodes[node];
  return sum / mesh.face_nodes[face].size();
}

std::vector<int> edges_of_face(const RawDisplacement& raw, int face) {
  std::vector<int> edges;
  if (raw.edge_count() == 0) return edges;
  const FaceNodes& nodes = raw.mesh.face_nodes[face];
  for (int k = 0; k < nodes.size(); ++k)
    for (const int edge : raw.edges->of_cell[raw.mesh.face_cells[face][0]])
      if (const auto [one, other] = raw.edges->nodes[edge];
          one == std::min(nodes[k], nodes.after(k)) && other == std::max(nodes[k], nodes.after(k)))
        edges.push_back(edge);
  return edges;
}

double edge_in_middle(const Mesh& mesh, int face) {
  const int corners = mesh.face_nodes[face].size();
  const double share = 1.0 / corners;  // of each corner in the middle
  return corners == 3 ? 4 * share * share : 2 * share;
}

Point displacement_of_middle(const RawDisplacement& raw, const std::vector<int>& /*tips*/, const Vector& coefficients,
                             int face) {
  const FaceNodes& nodes = raw.mesh.face_nodes[face];
  Point middle = coefficients.segment<dimension>(raw.of_face(face));
  for (const int node : nodes) middle += coefficients.segment<dimension>(raw.of_node(node)) / nodes.size();
  for (const int edge : edges_of_face(raw, face))
    middle += edge_in_middle(raw.mesh, face) * coefficients.segment<dimension>(raw.of_edge(edge));
  return middle;
}

Tensor mean_gradient(const RawDisplacement& raw, const std::vector<int>& tips, const Vector& coefficients, int cell) {
  const Mesh& mesh = raw.mesh;
  Tensor gradient = Tensor::Zero();
  for (const int face : mesh.cell_faces[cell]) {
    const double out = mesh.face_cells[face][0] == cell ? 1 : -1;
    for (const FaceFunction& function : face_functions(raw, tips, face))
      gradient += out / mesh.cell_measure[cell] * coefficients.segment<dimension>(function.coefficient) *
                  function.flow.transpose();
  }
  return gradient;
}

}  // namespace sprekk::poromechanics
