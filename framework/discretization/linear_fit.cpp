#include "framework/discretization/linear_fit.hpp"

#include <cmath>
#include <set>

#include "framework/dense/least_squares.hpp"
#include "framework/invariants.hpp"
#include "framework/mesh/search/point_location.hpp"

namespace sprekk {

std::vector<std::pair<int, double>> linear_fit(const Mesh& mesh, const Point& x,
                                               const std::function<bool(int, int)>& is_like) {
  const int home = PointLocation(mesh).cell_at(x);
  SPREKK_EXPECT(is_finite(x));
  if (home == none) return {};
  std::set<int> around;
  for (const int node : mesh.cell_nodes[home])
    for (const int cell : mesh.node_cells[node])
      if (mesh.cell_region[cell] == mesh.cell_region[home] && (cell == home || !is_like || is_like(home, cell)))
        around.insert(cell);
  const std::vector<int> cells(around.begin(), around.end());
  // Minimizes sum (a + b·(x_cell − x) − value)^2; the weights are the first row of the pseudo-inverse.
  Eigen::MatrixXd basis(cells.size(), 1 + dimension);
  const double scale = dimension == 2 ? std::sqrt(mesh.cell_measure[home]) : std::cbrt(mesh.cell_measure[home]);
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

}  // namespace sprekk
