#include "couplers/two_level/nodal_values.hpp"

#include <algorithm>

#include "framework/dense/symmetric_eigen.hpp"
#include "framework/invariants.hpp"

namespace sprekk::couplers {

namespace {

/// Part of the distances of cells: values of cells that lie within this along a direction do not determine the gradient
/// along it.
constexpr double round_off = 1e-12;

}  // namespace

NodalValues::NodalValues(const Mesh& mesh, From from) : mesh_(&mesh), from_(from) {
  std::vector<Triplet> cells, faces;
  std::vector<char> is_linear(mesh.node_count(), 0);  // whether linear fields are exact at a node
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
    int determined = 0;  // directions along which the gradient is known
    for (int k = 0; k < dimension; ++k) {
      const Point along = directions.axes.col(k);
      if (directions.values[k] > round_off * mean.squaredNorm() && directions.values[k] > round_off * moment.trace()) {
        inverse += along * along.transpose() / directions.values[k];
        ++determined;
      }
    }
    is_linear[node] = determined == dimension;
    const Point slope = inverse * mean;
    for (int i = 0; i < count; ++i)
      (i < static_cast<int>(cell_count) ? cells : faces)
          .emplace_back(node, sources[i].first, weight[i] * (1 - slope.dot(sources[i].second - x - mean)));
  }
  from_cells_.resize(mesh.node_count(), mesh.cell_count());
  from_cells_.setFromTriplets(cells.begin(), cells.end());
  from_faces_.resize(mesh.node_count(), mesh.face_count());
  from_faces_.setFromTriplets(faces.begin(), faces.end());
  if (from != From::cells) return;
  // Cells at nodes where linear fields are not exact correct nothing.
  std::vector<Triplet> means;
  has_mean_ = Vector::Zero(mesh.cell_count());
  for (int cell = 0; cell < mesh.cell_count(); ++cell) {
    if (!std::ranges::all_of(mesh.cell_nodes[cell], [&](int node) { return is_linear[node] != 0; })) continue;
    has_mean_[cell] = 1;
    const Place centre = place(cell, mesh.cell_center[cell]);  // of a triangle; nearly that of a quadrilateral
    for (int i = 0; i < 3; ++i) means.emplace_back(cell, centre.nodes[i], centre.share[i]);
  }
  mean_of_nodes_.resize(mesh.cell_count(), mesh.node_count());
  mean_of_nodes_.setFromTriplets(means.begin(), means.end());
}

void NodalValues::set(int components, const Vector& cells, const Vector& faces) {
  using Table = Eigen::Map<const Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor>>;
  const Table of_cells(cells.data(), mesh_->cell_count(), components);
  values_ = from_cells_ * of_cells;
  // A field that is curved, as the pressure beside a wall that fluid leaves through, would have other means than the
  // cells. What is missing is added in the same way (Van Cittert 1931). Two corrections leave the smallest error; many
  // would enlarge what differs from cell to cell.
  constexpr int corrections = 2;
  for (int i = 0; from_ == From::cells && i < corrections; ++i) {
    const Eigen::MatrixXd missing = has_mean_.asDiagonal() * Eigen::MatrixXd(of_cells) - mean_of_nodes_ * values_;
    values_ += from_cells_ * missing;
  }
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
