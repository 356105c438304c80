#include "components/poromechanics/fem/face_functions.hpp"

#include <Eigen/Geometry>
#include <algorithm>
#include <array>

#include "components/poromechanics/fem/gauss_points.hpp"
#include "components/poromechanics/fem/reference_cell.hpp"

namespace sprekk::poromechanics {

namespace {

/// The edge from each node of a face to the next, or none where it has no function.
ShortList<4> edges_of_sides(const RawDisplacement& raw, int face) {
  const FaceNodes& nodes = raw.mesh.face_nodes[face];
  ShortList<4> sides;
  for (int k = 0; k < nodes.size(); ++k) {
    const std::array<int, 2> ends{std::min(nodes[k], nodes.after(k)), std::max(nodes[k], nodes.after(k))};
    int found = none;
    if (raw.edge_count() > 0)
      for (const int edge : raw.edges->of_cell[raw.mesh.face_cells[face][0]])
        if (edge != none && raw.edges->nodes[edge] == ends) found = edge;
    sides.push_back(found);
  }
  return sides;
}

/// The functions of the nodes, of all sides and of the face, at x and y in the reference triangle or square.
std::vector<ReferenceFunction> functions_at(double x, double y, int corners) {
  const ReferenceFunction in_x[2] = {{1 - x, {-1, 0, 0}}, {x, {1, 0, 0}}},
                          in_y[2] = {{1 - y, {0, -1, 0}}, {y, {0, 1, 0}}};
  if (corners == 3) {
    const ReferenceFunction a{1 - x - y, {-1, -1, 0}}, &b = in_x[1], &c = in_y[1];
    return {a, b, c, 4 * (a * b), 4 * (b * c), 4 * (c * a), 27 * (a * b * c)};
  }
  const ReferenceFunction along_x = 4 * (in_x[0] * in_x[1]), along_y = 4 * (in_y[0] * in_y[1]);
  return {in_x[0] * in_y[0], in_x[1] * in_y[0], in_x[1] * in_y[1], in_x[0] * in_y[1], along_x * in_y[0],
          in_x[1] * along_y, along_x * in_y[1], in_x[0] * along_y, along_x * along_y};
}

}  // namespace

std::vector<FacePoint> face_points(const RawDisplacement& raw, int face) {
  const Mesh& mesh = raw.mesh;
  const FaceNodes& nodes = mesh.face_nodes[face];
  const int corners = nodes.size();
  const ShortList<4> sides = edges_of_sides(raw, face);
  std::vector<Point> arms;  // of nodes from the first, and of middle nodes from the middles of sides
  for (const int node : nodes) arms.push_back(mesh.nodes[node] - mesh.nodes[nodes[0]]);
  for (const int edge : sides) arms.push_back(edge == none ? Point(Point::Zero()) : raw.edges->shift(mesh, edge));
  std::vector<FacePoint> points;
  for (const GaussPoint& first : four_gauss_points())
    for (const GaussPoint& second : four_gauss_points()) {
      FacePoint point{mesh.nodes[nodes[0]], first.weight * second.weight, Point::Zero(), {}};
      const double shrink = corners == 3 ? 1 - first.at : 1;
      const std::vector<ReferenceFunction> functions = functions_at(first.at, shrink * second.at, corners);
      Point along_x = Point::Zero(), along_y = Point::Zero();
      for (std::size_t k = 0; k < arms.size(); ++k) {
        point.x += functions[k].value * arms[k];
        along_x += functions[k].slope.x() * arms[k];
        along_y += functions[k].slope.y() * arms[k];
      }
      for (int k = 0; k < static_cast<int>(functions.size()); ++k)
        if (k < corners || k == 2 * corners || sides[k - corners] != none) point.value.push_back(functions[k].value);
      const Point area = along_x.cross(along_y);
      point.weight *= shrink * area.norm();
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

Point middle_of_face(const RawDisplacement& raw, int face) {
  Point middle = Point::Zero();
  for (const int node : raw.mesh.face_nodes[face]) middle += raw.mesh.nodes[node];
  middle /= raw.mesh.face_nodes[face].size();
  for (const int edge : edges_of_face(raw, face))
    middle += edge_in_middle(raw.mesh, face) * raw.edges->shift(raw.mesh, edge);
  return middle;
}

std::vector<int> edges_of_face(const RawDisplacement& raw, int face) {
  std::vector<int> edges;
  for (const int edge : edges_of_sides(raw, face))
    if (edge != none) edges.push_back(edge);
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
