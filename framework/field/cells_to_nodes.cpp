#include "framework/field/cells_to_nodes.hpp"

#include <Eigen/QR>
#include <algorithm>
#include <cmath>

#include "framework/invariants.hpp"
#include "framework/matrix_of.hpp"

namespace sprekk {
namespace {

constexpr double flat = 0.05;   // the least pivot over the largest with which cells determine a linear function
constexpr int most_layers = 3;  // beyond them there are not enough cells in this corner

void add_layer(const Mesh& mesh, std::vector<int>& cells) {
  const std::vector<int> before = cells;
  for (const int cell : before)
    for (const int face : mesh.cell_faces[cell])
      for (const int other : mesh.face_cells[face])
        if (other != none && std::ranges::find(cells, other) == cells.end()) cells.push_back(other);
}

}  // namespace

SparseMatrix cells_to_nodes(const Mesh& mesh) {
  std::vector<Triplet> entries;
  for (int node = 0; node < mesh.node_count(); ++node) {
    std::vector<int> cells(mesh.node_cells[node].begin(), mesh.node_cells[node].end());
    SPREKK_ASSERT(!cells.empty(), node);
    Eigen::CompleteOrthogonalDecomposition<Eigen::MatrixXd> fit;
    Eigen::VectorXd roots;
    for (int layer = 0; layer <= most_layers; ++layer) {
      if (layer > 0) add_layer(mesh, cells);
      // Minimizes sum area (a + b·(x_cell − x) − value)^2; the weights of a are the first row of the pseudo-inverse.
      const auto count = static_cast<Eigen::Index>(cells.size());
      double largest = 0;
      for (const int cell : cells) largest = std::max(largest, mesh.cell_measure[cell]);
      const double size = std::pow(largest, 1.0 / dimension);
      Eigen::MatrixXd basis(count, 1 + dimension);
      roots.resize(count);
      for (Eigen::Index k = 0; k < count; ++k) {
        roots[k] = std::sqrt(mesh.cell_measure[cells[k]] / largest);
        basis(k, 0) = roots[k];
        basis.row(k).tail<dimension>() = roots[k] / size * (mesh.cell_center[cells[k]] - mesh.nodes[node]);
      }
      fit.setThreshold(flat);
      fit.compute(basis);
      if (fit.rank() == 1 + dimension) break;
    }
    const Eigen::MatrixXd inverse = fit.pseudoInverse();
    for (std::size_t k = 0; k < cells.size(); ++k) {
      const auto column = static_cast<Eigen::Index>(k);
      entries.emplace_back(node, cells[k], inverse(0, column) * roots[column]);
    }
  }
  return matrix_of(mesh.node_count(), mesh.cell_count(), entries);
}

}  // namespace sprekk
