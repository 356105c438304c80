#include "couplers/two_level/plane/nodal_values.hpp"

#include "framework/discretization/principal_axes.hpp"
#include "framework/invariants.hpp"

namespace sprekk::couplers {

namespace {

/// A direction in which the second moment of the cell centres is below this part of the squared distance from the node
/// (round-off) does not determine a gradient.
constexpr double round_off = 1e-12;

}  // namespace

NodalValues::NodalValues(const Mesh& mesh, From from) : mesh_(&mesh), from_(from) {
  std::vector<Triplet> cells, faces;
  for (int node = 0; node < mesh.node_count(); ++node) {
    const Point& x = mesh.nodes[node];
    std::vector<std::pair<int, Point>> sources;  // cells first, then faces
    if (from == From::mean_of_cells) {
      double area = 0;
      for (const int cell : mesh.node_cells[node]) area += mesh.cell_measure[cell];
      for (const int cell : mesh.node_cells[node]) cells.emplace_back(node, cell, mesh.cell_measure[cell] / area);
      continue;
    }
    for (const int cell : mesh.node_cells[node]) sources.emplace_back(cell, mesh.cell_center[cell]);
    const std::size_t cell_count = sources.size();
    if (from == From::cells_and_faces)
      for (const int face : mesh.node_faces[node])
        if (mesh.face_cells[face][1] == none) sources.emplace_back(face, mesh.face_center[face]);
    // Minimizes the sum of w_i (a + b·(x_i − x) − v_i)^2 with w_i = 1/|x_i − x|^2; a is the value at the node. At the
    // optimum a = v̄ − b·(x̄ − x) with the weighted means, and b follows from the differences to them alone.
    const int count = static_cast<int>(sources.size());
    Vector weight(count);
    Point mean = Point::Zero();
    for (int i = 0; i < count; ++i) {
      const Point offset = sources[i].second - x;
      weight[i] = 1 / offset.squaredNorm();
      mean += weight[i] * offset;
    }
    mean /= weight.sum();
    weight /= weight.sum();
    Tensor moment = Tensor::Zero();
    for (int i = 0; i < count; ++i) {
      const Point centred = sources[i].second - x - mean;
      moment += weight[i] * centred * centred.transpose();
    }
    // One or two sources (in corners) say nothing about some direction: there b is zero, so that constants stay exact.
    const PrincipalAxes directions = principal_axes(moment);
    Tensor inverse = Tensor::Zero();
    for (int k = 0; k < dimension; ++k) {
      const Point along = directions.axes.col(k);
      if (directions.values[k] > round_off * mean.squaredNorm() && directions.values[k] > round_off * moment.trace())
        inverse += along * along.transpose() / directions.values[k];
    }
    const Point slope = inverse * mean;
    for (int i = 0; i < count; ++i)
      (i < static_cast<int>(cell_count) ? cells : faces)
          .emplace_back(node, sources[i].first, weight[i] * (1 - slope.dot(sources[i].second - x - mean)));
  }
  from_cells_.resize(mesh.node_count(), mesh.cell_count());
  from_cells_.setFromTriplets(cells.begin(), cells.end());
  from_faces_.resize(mesh.node_count(), mesh.face_count());
  from_faces_.setFromTriplets(faces.begin(), faces.end());
}

void NodalValues::set(int components, const Vector& cells, const Vector& faces) {
  using Table = Eigen::Map<const Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor>>;
  values_ = from_cells_ * Table(cells.data(), mesh_->cell_count(), components);
  if (from_ == From::cells_and_faces) values_ += from_faces_ * Table(faces.data(), mesh_->face_count(), components);
}

void NodalValues::set_nodes(int components, const Vector& nodes) {
  SPREKK_EXPECT(nodes.size() == static_cast<Eigen::Index>(mesh_->node_count()) * components, nodes.size(), components);
  values_ = nodes.reshaped<Eigen::RowMajor>(mesh_->node_count(), components);
}

NodalValues::Place NodalValues::place(int cell, const Point& x) const {
  const Ring& corners = mesh_->cell_nodes[cell];
  std::array<int, 3> n{corners[0], corners[1], corners[2]};
  if (corners.size() == 4) {
    // The half on whose side of the diagonal the point lies.
    const Point along = mesh_->nodes[n[2]] - mesh_->nodes[n[0]], away = x - mesh_->nodes[n[0]];
    if (along[0] * away[1] > along[1] * away[0]) n = {n[0], n[2], corners[3]};
  }
  const Point &a = mesh_->nodes[n[0]], &b = mesh_->nodes[n[1]], &c = mesh_->nodes[n[2]];
  const auto cross = [](const Point& u, const Point& v) { return u[0] * v[1] - u[1] * v[0]; };
  const double area = cross(b - a, c - a);
  const double l0 = cross(b - x, c - x) / area, l1 = cross(c - x, a - x) / area;
  return {n, {l0, l1, 1 - l0 - l1}};
}

}  // namespace sprekk::couplers
