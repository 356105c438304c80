#include "framework/discretization/linear_fit.hpp"

#include <cmath>
#include <map>
#include <set>
#include <stdexcept>

#include "framework/dense/least_squares.hpp"
#include "framework/invariants.hpp"
#include "framework/mesh/geometry.hpp"
#include "framework/mesh/search/point_location.hpp"

namespace sprekk {
namespace {

double size_of(const Mesh& mesh, int cell) {
  return dimension == 2 ? std::sqrt(mesh.cell_measure[cell]) : std::cbrt(mesh.cell_measure[cell]);
}

std::vector<std::pair<int, double>> linear_fit_in(const Mesh& mesh, int home, const Point& x,
                                                  const std::function<bool(int, int)>& is_like) {
  std::set<int> around;
  for (const int node : mesh.cell_nodes[home])
    for (const int cell : mesh.node_cells[node])
      if (mesh.cell_region[cell] == mesh.cell_region[home] && (cell == home || !is_like || is_like(home, cell)))
        around.insert(cell);
  const std::vector<int> cells(around.begin(), around.end());
  // Minimizes sum (a + b·(x_cell − x) − value)^2; the weights are the first row of the pseudo-inverse.
  Eigen::MatrixXd basis(cells.size(), 1 + dimension);
  const double scale = size_of(mesh, home);
  SPREKK_ASSERT(scale > 0, home, scale);
  for (std::size_t i = 0; i < cells.size(); ++i) {
    const Point offset = (mesh.cell_center[cells[i]] - x) / scale;
    basis.row(i) << 1, offset.transpose();
  }
  const LeastSquares fit(basis);
  if (fit.rank() < 1 + dimension) return {{home, 1.0}};
  const Eigen::MatrixXd inverse = fit.pseudo_inverse();
  std::vector<std::pair<int, double>> weights;
  for (std::size_t i = 0; i < cells.size(); ++i) weights.emplace_back(cells[i], inverse(0, i));
  return weights;
}

}  // namespace

std::vector<std::pair<int, double>> linear_fit(const Mesh& mesh, const Point& x,
                                               const std::function<bool(int, int)>& is_like) {
  SPREKK_EXPECT(is_finite(x));
  const int home = PointLocation(mesh).cell_at(x);
  return home == none ? std::vector<std::pair<int, double>>() : linear_fit_in(mesh, home, x, is_like);
}

std::vector<std::pair<int, double>> line_source(const Mesh& mesh, const std::vector<Point>& line,
                                                const std::function<bool(int, int)>& is_like) {
  SPREKK_EXPECT(line.size() > 1, line.size());
  constexpr double piece = 0.25;  // of the size of cells: so short that the cells around do not count in jumps
  const PointLocation location(mesh);
  double length = 0;
  for (std::size_t k = 1; k < line.size(); ++k) length += (line[k] - line[k - 1]).norm();
  std::map<int, double> weights;
  const std::function<void(const Point&, const Point&)> spread = [&](const Point& from, const Point& to) {
    const Point middle = 0.5 * (from + to);
    double size = HUGE_VAL;
    int home = none;
    for (const Point& at : {from, to, middle}) {
      home = location.cell_at(at);
      if (home == none) throw std::invalid_argument("there is no cell at " + to_text(at));
      size = std::min(size, size_of(mesh, home));
    }
    const double part = (to - from).norm();
    if (part > piece * size) {
      spread(from, middle);
      spread(middle, to);
      return;
    }
    for (const auto& [cell, weight] : linear_fit_in(mesh, home, middle, is_like))
      weights[cell] += weight * part / length;
  };
  for (std::size_t k = 1; k < line.size(); ++k) spread(line[k - 1], line[k]);
  return {weights.begin(), weights.end()};
}

}  // namespace sprekk
