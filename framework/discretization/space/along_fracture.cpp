#include "framework/discretization/along_fracture.hpp"

#include <algorithm>
#include <map>

#include "framework/dense/least_squares.hpp"
#include "framework/invariants.hpp"
#include "framework/round_off.hpp"

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

/// The weights of cells in the value at a point, and in how many directions they determine the slope.
struct Fit {
  Eigen::Index directions = 0;
  std::vector<std::pair<int, double>> weights;
};

/// Of the linear function that fits these cells best; it is constant in directions in which they do not differ.
Fit fitted(const Mesh& mesh, const std::vector<int>& cells, const FractureCell& home, const Point& x) {
  const auto count = static_cast<Eigen::Index>(cells.size());
  Point mean = Point::Zero();
  for (const int cell : cells) mean += mesh.fracture_cells[cell].center / static_cast<double>(count);
  const auto from_mean = [&](const Point& at) { return ((at - mean) / home.size()).transpose() * home.tangents; };
  Fit result;
  Eigen::VectorXd by_slope = Eigen::VectorXd::Zero(count);
  if (count > 1) {
    Eigen::MatrixXd slopes(count, dimension - 1);
    for (Eigen::Index i = 0; i < count; ++i) slopes.row(i) = from_mean(mesh.fracture_cells[cells[i]].center);
    const LeastSquares fit(slopes, rounding::far_above);
    result.directions = fit.rank();
    by_slope = (from_mean(x) * fit.pseudo_inverse()).transpose();
  }
  for (Eigen::Index i = 0; i < count; ++i)
    result.weights.emplace_back(cells[i], 1 / static_cast<double>(count) + by_slope[i]);
  return result;
}

/// The same from the cells around a node, with more of them where these do not determine the slope. A row of cells
/// determines it along the row.
Fit fitted_around(const Mesh& mesh, const std::vector<int>& around, const FractureCell& home, const Point& x) {
  constexpr int most_rings = 2;  // a corner cell has one neighbour, and that two more
  Fit best;
  for (int rings = 0; rings <= most_rings && best.directions < dimension - 1; ++rings) {
    Fit fit = fitted(mesh, spread(mesh, around, rings, [](int) { return true; }), home, x);
    if (rings == 0 || fit.directions > best.directions) best = std::move(fit);
  }
  return best;
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
    for (const auto& [other, weight] : fitted_around(mesh, around, home, x).weights) sums[other] += shares[n] * weight;
  }
  return {sums.begin(), sums.end()};
}

}  // namespace sprekk
