#include "framework/scene/plane/transferred_cells.hpp"

#include <Eigen/Dense>
#include <algorithm>
#include <map>
#include <vector>

#include "framework/invariants.hpp"
#include "framework/remeshing/overlap.hpp"
#include "framework/round_off.hpp"

namespace sprekk {
namespace {

/// Values that are linear within the cells of a mesh, with their means.
class LinearInCells {
 public:
  LinearInCells(const Mesh& mesh, const Vector& means, int components, const std::map<int, double>& at_faces)
      : mesh_(mesh), means_(means), components_(components), at_faces_(at_faces), cells_at_(mesh.nodes.size()) {
    for (int cell = 0; cell < mesh.cell_count(); ++cell)
      for (const int node : mesh.cell_nodes[cell]) cells_at_[node].push_back(cell);
  }

  /// The value at x of the linear function of a cell, one for each component.
  Vector at(int cell, const Point& x) {
    auto found = gradients_.find(cell);
    if (found == gradients_.end()) found = gradients_.emplace(cell, gradient(cell)).first;
    return means_.segment(cell * components_, components_) + found->second * (x - mesh_.cell_center[cell]);
  }

 private:
  using Gradient = Eigen::Matrix<double, Eigen::Dynamic, dimension>;

  Gradient gradient(int cell) const {
    std::vector<int> around;
    for (const int node : mesh_.cell_nodes[cell])
      around.insert(around.end(), cells_at_[node].begin(), cells_at_[node].end());
    std::ranges::sort(around);
    around.erase(std::unique(around.begin(), around.end()), around.end());
    Eigen::Matrix<double, dimension, dimension> normal = Eigen::Matrix<double, dimension, dimension>::Zero();
    Gradient right = Gradient::Zero(components_, dimension);
    const Vector own = means_.segment(cell * components_, components_);
    Vector low = own, high = own;
    const auto fit = [&](const Point& x, const Vector& value) {
      low = low.cwiseMin(value);
      high = high.cwiseMax(value);
      const Point way = x - mesh_.cell_center[cell];
      const double weight = 1 / way.squaredNorm();
      normal += weight * way * way.transpose();
      right += weight * (value - own) * way.transpose();
    };
    for (const int other : around) {
      if (mesh_.cell_region[other] != mesh_.cell_region[cell]) continue;
      if (other != cell) fit(mesh_.cell_center[other], means_.segment(other * components_, components_));
      if (at_faces_.empty()) continue;
      for (const int face : mesh_.cell_faces[other])
        if (const auto known = at_faces_.find(face); known != at_faces_.end() && touches(face, cell))
          fit(mesh_.face_center[face], Vector::Constant(1, known->second));
    }
    const double half_trace = normal.trace() / dimension;
    if (!(normal.determinant() > rounding::far_above * half_trace * half_trace))
      return Gradient::Zero(components_, dimension);
    Gradient gradient = right * normal.inverse();
    for (int k = 0; k < components_; ++k) {
      double part = 1;
      for (const int node : mesh_.cell_nodes[cell]) {
        const double rise = gradient.row(k).dot(mesh_.nodes[node] - mesh_.cell_center[cell]);
        const double room = rise > 0 ? high[k] - own[k] : low[k] - own[k];
        if (rise != 0) part = std::min(part, room / rise);
      }
      gradient.row(k) *= part;
    }
    return gradient;
  }

  bool touches(int face, int cell) const {
    return std::ranges::any_of(mesh_.face_nodes[face], [&](int node) {
      return std::ranges::find(mesh_.cell_nodes[cell], node) != std::end(mesh_.cell_nodes[cell]);
    });
  }

  const Mesh& mesh_;
  const Vector& means_;
  const int components_;
  const std::map<int, double>& at_faces_;
  std::vector<std::vector<int>> cells_at_;  ///< by node
  std::map<int, Gradient> gradients_;       ///< by cell, computed when they are needed
};

/// The mean over what a new cell has in common with an old one.
double mean_of_pieces(const std::vector<LinearPiece>& pieces, const Corners& cell, int old_cell,
                      const Corners& old_corners, LinearInCells& linear) {
  double sum = 0, area = 0;
  for (const LinearPiece& piece : pieces) {
    const CommonPart part = common_part(cell, {piece.corners[0], piece.corners[1], piece.corners[2]});
    if (!(part.area > 0)) continue;
    area += part.area;
    sum += part.area * piece.weight * piece.at(part.centre);
    if (piece.weight < 1) sum += part.area * (1 - piece.weight) * linear.at(old_cell, part.centre)[0];
  }
  // Of a common part that is a line except for rounding the pieces may have nothing.
  return area > 0 ? sum / area : linear.at(old_cell, common_part(cell, old_corners).centre)[0];
}

}  // namespace

Vector transferred_cells(const Field& old, const MeshChange& change, const Mesh& old_mesh, const Mesh& new_mesh,
                         const KnownWithinCells& known) {
  SPREKK_EXPECT((known.pieces.empty() && known.at_faces.empty()) || old.spec().components == 1, old.name());
  const int components = old.spec().components;
  SPREKK_EXPECT(old.accepted().size() == static_cast<Eigen::Index>(old_mesh.cell_count()) * components, old.name());
  if (old.spec().is_amount) return shared_in_cells(change, old_mesh, old.accepted(), components);
  Vector values = Vector::Zero(static_cast<int>(change.cell.size()) * components);
  LinearInCells linear(old_mesh, old.accepted(), components, known.at_faces);
  // One row for each new cell: its overlap with old cells.
  const Eigen::SparseMatrix<double, Eigen::RowMajor> overlap = change.overlap;
  for (int cell = 0; cell < static_cast<int>(change.cell.size()); ++cell) {
    auto value = values.segment(cell * components, components);
    if (change.cell[cell] != none) {
      value = old.accepted().segment(change.cell[cell] * components, components);
      continue;
    }
    double area = 0;
    for (decltype(overlap)::InnerIterator entry(overlap, cell); entry; ++entry) area += entry.value();
    SPREKK_ASSERT(area > 0, cell, area);
    const Corners corners = corners_of(new_mesh.nodes, new_mesh.cell_nodes[cell]);
    for (decltype(overlap)::InnerIterator entry(overlap, cell); entry; ++entry) {
      const int from = static_cast<int>(entry.col());
      const Corners old_corners = corners_of(old_mesh.nodes, old_mesh.cell_nodes[from]);
      if (const auto pieces = known.pieces.find(from); pieces != known.pieces.end()) {
        value[0] += entry.value() / area * mean_of_pieces(pieces->second, corners, from, old_corners, linear);
        continue;
      }
      value += entry.value() / area * linear.at(from, common_part(corners, old_corners).centre);
    }
  }
  return values;
}

}  // namespace sprekk
