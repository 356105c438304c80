#include "framework/discretization/along_fracture.hpp"

#include <algorithm>
#include <map>

#include "framework/dense/least_squares.hpp"
#include "framework/invariants.hpp"

namespace sprekk {
namespace {

/// `cells`, and the cells that are reached from them across at most `rings` ridges, all of which `accepts` takes.
template <class Accepts>
std::vector<int> spread(const Mesh& mesh, std::vector<int> cells, int rings, const Accepts& accepts) {
  for (std::size_t first = 0, last = cells.size(); rings > 0 && first < last; --rings, last = cells.size())
    for (; first < last; ++first)
      for (const int ridge : mesh.fracture_cells[cells[first]].ridges) {
        if (mesh.ridges[ridge].kind != Ridge::Kind::inside) continue;
        for (const int other : mesh.ridges[ridge].cells)
          if (accepts(other) && std::ranges::find(cells, other) == cells.end()) cells.push_back(other);
      }
  return cells;
}

/// The weights of these cells in the value at x of the linear function that fits them best; empty where they do not
/// determine its slope.
std::vector<std::pair<int, double>> fitted(const Mesh& mesh, const std::vector<int>& cells, const FractureCell& home,
                                           const Point& x) {
  Eigen::MatrixXd basis(cells.size(), dimension);
  for (std::size_t i = 0; i < cells.size(); ++i)
    basis.row(static_cast<Eigen::Index>(i)) << 1,
        ((mesh.fracture_cells[cells[i]].center - x) / home.size()).transpose() * home.tangents;
  const LeastSquares fit(basis);
  if (fit.rank() < dimension) return {};
  const Eigen::MatrixXd inverse = fit.pseudo_inverse();
  std::vector<std::pair<int, double>> weights;
  for (std::size_t i = 0; i < cells.size(); ++i)
    weights.emplace_back(cells[i], inverse(0, static_cast<Eigen::Index>(i)));
  return weights;
}

/// The coordinates of x for the corners of a cell's face: linear along edges, and 1 in all (Wachspress 1975).
std::vector<double> coordinates(const Mesh& mesh, const FractureCell& home, const Point& x) {
  const FaceNodes& nodes = mesh.face_nodes[home.faces[0]];
  const int count = static_cast<int>(nodes.size());
  const auto corner = [&](int k) -> TangentialVector {
    return home.tangents.transpose() * (mesh.nodes[nodes[(k + count) % count]] - x) / home.size();
  };
  const auto area = [](const TangentialVector& a, const TangentialVector& b) {
    return std::abs(a[0] * b[dimension - 2] - a[dimension - 2] * b[0]);
  };
  std::vector<double> shares(count);
  double sum = 0;
  for (int n = 0; n < count; ++n) {
    shares[n] = area(corner(n) - corner(n - 1), corner(n + 1) - corner(n));
    for (int k = 0; k < count; ++k)  // the edges that do not end here
      if (k != n && (k + 1) % count != n) shares[n] *= area(corner(k), corner(k + 1));
    sum += shares[n];
  }
  for (double& share : shares) share /= sum;
  return shares;
}

}  // namespace

std::vector<std::pair<int, double>> along_fracture(const Mesh& mesh, int cell, const Point& x) {
  SPREKK_EXPECT(is_index(cell, mesh.fracture_cell_count()) && is_finite(x), cell);
  const FractureCell& home = mesh.fracture_cells[cell];
  const FaceNodes& nodes = mesh.face_nodes[home.faces[0]];
  const std::vector<double> shares = coordinates(mesh, home, x);
  std::map<int, double> sums;
  for (std::size_t n = 0; n < shares.size(); ++n) {
    const auto has_node = [&](int other) {
      const FaceNodes& others = mesh.face_nodes[mesh.fracture_cells[other].faces[0]];
      return std::ranges::find(others, nodes[n]) != others.end();
    };
    const std::vector<int> around = spread(mesh, {cell}, mesh.fracture_cell_count(), has_node);
    std::vector<std::pair<int, double>> weights = fitted(mesh, around, home, x);
    if (weights.empty()) weights = fitted(mesh, spread(mesh, around, 1, [](int) { return true; }), home, x);
    if (weights.empty()) weights = {{cell, 1.0}};
    for (const auto& [other, weight] : weights) sums[other] += shares[n] * weight;
  }
  return {sums.begin(), sums.end()};
}

}  // namespace sprekk
