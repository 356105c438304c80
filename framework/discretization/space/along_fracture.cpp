#include "framework/discretization/along_fracture.hpp"

#include "framework/dense/least_squares.hpp"
#include "framework/invariants.hpp"

namespace sprekk {

std::vector<std::pair<int, double>> along_fracture(const Mesh& mesh, int cell, const Point& x) {
  SPREKK_EXPECT(is_index(cell, mesh.fracture_cell_count()) && is_finite(x), cell);
  const FractureCell& home = mesh.fracture_cells[cell];
  std::vector<int> around = {cell};
  for (const int ridge : home.ridges)
    if (mesh.ridges[ridge].kind == Ridge::Kind::inside)
      for (const int other : mesh.ridges[ridge].cells)
        if (other != cell) around.push_back(other);
  // The linear function that fits the centres best; its value at x is the first coefficient.
  Eigen::MatrixXd basis(around.size(), dimension);
  for (std::size_t i = 0; i < around.size(); ++i)
    basis.row(static_cast<Eigen::Index>(i)) << 1,
        ((mesh.fracture_cells[around[i]].center - x) / home.size()).transpose() * home.tangents;
  const LeastSquares fit(basis);
  if (fit.rank() < dimension) return {{cell, 1.0}};
  const Eigen::MatrixXd inverse = fit.pseudo_inverse();
  std::vector<std::pair<int, double>> weights;
  for (std::size_t i = 0; i < around.size(); ++i)
    weights.emplace_back(around[i], inverse(0, static_cast<Eigen::Index>(i)));
  return weights;
}

}  // namespace sprekk
