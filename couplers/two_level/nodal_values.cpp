#include "couplers/two_level/nodal_values.hpp"

#include <Eigen/QR>

namespace sprekk::couplers {

NodalValues::NodalValues(const Mesh& mesh, From from) : mesh_(&mesh), from_(from) {
  std::vector<Triplet> cells, faces;
  for (int node = 0; node < mesh.node_count(); ++node) {
    const Point& x = mesh.nodes[node];
    std::vector<std::pair<int, Point>> sources;  // cells first, then faces
    if (from == From::mean_of_cells) {
      double area = 0;
      for (const int cell : mesh.node_cells[node]) area += mesh.cell_area[cell];
      for (const int cell : mesh.node_cells[node]) cells.emplace_back(node, cell, mesh.cell_area[cell] / area);
      continue;
    }
    for (const int cell : mesh.node_cells[node]) sources.emplace_back(cell, mesh.cell_center[cell]);
    const std::size_t cell_count = sources.size();
    if (from == From::cells_and_faces)
      for (const int face : mesh.node_faces[node])
        if (mesh.face_cells[face][1] == none) sources.emplace_back(face, mesh.face_center[face]);
    // Minimizes the sum of (a + b·(x_i − x) − v_i)^2 / |x_i − x|^2; a is the value at the node.
    const int count = static_cast<int>(sources.size());
    double scale = 0;
    for (const auto& [entity, at] : sources) scale = std::max(scale, (at - x).norm());
    Eigen::MatrixXd basis(count, 3);
    Vector weight(count);
    for (int i = 0; i < count; ++i) {
      const Point offset = (sources[i].second - x) / scale;
      weight[i] = 1 / offset.norm();
      basis.row(i) = weight[i] * Eigen::RowVector3d(1, offset[0], offset[1]);
    }
    const Eigen::MatrixXd inverse = basis.completeOrthogonalDecomposition().pseudoInverse();
    for (int i = 0; i < count; ++i)
      (i < static_cast<int>(cell_count) ? cells : faces)
          .emplace_back(node, sources[i].first, inverse(0, i) * weight[i]);
  }
  from_cells_.resize(mesh.node_count(), mesh.cell_count());
  from_cells_.setFromTriplets(cells.begin(), cells.end());
  from_faces_.resize(mesh.node_count(), mesh.face_count());
  from_faces_.setFromTriplets(faces.begin(), faces.end());
}

void NodalValues::set(int components, const Vector& cells, const Vector& faces) {
  using Table = Eigen::Map<const Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor>>;
  components_ = components;
  values_ = from_cells_ * Table(cells.data(), mesh_->cell_count(), components);
  if (from_ == From::cells_and_faces) values_ += from_faces_ * Table(faces.data(), mesh_->face_count(), components);
}

Vector NodalValues::at(int cell, const Point& x) const {
  const std::array<int, 3>& n = mesh_->cell_nodes[cell];
  const Point &a = mesh_->nodes[n[0]], &b = mesh_->nodes[n[1]], &c = mesh_->nodes[n[2]];
  const auto cross = [](const Point& u, const Point& v) { return u[0] * v[1] - u[1] * v[0]; };
  const double area = cross(b - a, c - a);
  const double l0 = cross(b - x, c - x) / area, l1 = cross(c - x, a - x) / area;
  return l0 * values_.row(n[0]) + l1 * values_.row(n[1]) + (1 - l0 - l1) * values_.row(n[2]);
}

}  // namespace sprekk::couplers
