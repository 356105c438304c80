#include "components/fracture_flow/tpfa/equivalent_radius.hpp"

#include <algorithm>
#include <cmath>
#include <map>

#include "framework/dense/lu.hpp"
#include "framework/invariants.hpp"

namespace sprekk::fracture_flow {
namespace {

constexpr int layers = 4;  // of cells around the first one: Thiem's rate within 0.05 %

/// Those that are reached over so many ridges inside of the fracture, with their numbers in this order.
std::map<int, int> cells_around(const Mesh& mesh, int cell) {
  std::map<int, int> numbers = {{cell, 0}};
  std::vector<int> last = {cell};
  for (int layer = 0; layer < layers; ++layer) {
    std::vector<int> next;
    for (const int from : last)
      for (const int ridge : mesh.fracture_cells[from].ridges)
        if (mesh.ridges[ridge].kind == Ridge::Kind::inside)
          for (const int other : mesh.ridges[ridge].cells)
            if (numbers.try_emplace(other, static_cast<int>(numbers.size())).second) next.push_back(other);
    last = std::move(next);
  }
  return numbers;
}

}  // namespace

double equivalent_radius(const Mesh& mesh, const MimeticDrops& drops, int cell, const Point& at,
                         const std::vector<std::pair<int, double>>& shares) {
  SPREKK_EXPECT(is_index(cell, mesh.fracture_cell_count()) && is_finite(at), cell);
  const auto is_inside = [&](int ridge) { return mesh.ridges[ridge].kind == Ridge::Kind::inside; };
  if (!std::ranges::all_of(mesh.fracture_cells[cell].ridges, is_inside)) return 0;
  const std::map<int, int> cells = cells_around(mesh, cell);
  std::map<int, int> ridges;  // their numbers among the unknowns, behind the cells
  for (const auto& [c, number] : cells)
    for (const int ridge : mesh.fracture_cells[c].ridges)
      ridges.try_emplace(ridge, static_cast<int>(cells.size() + ridges.size()));
  // Pressures of cells and flows through ridges, out of their first cells, where T/mu = 1 and q = 2 pi.
  const auto count = static_cast<Eigen::Index>(cells.size() + ridges.size());
  Eigen::MatrixXd matrix = Eigen::MatrixXd::Zero(count, count);
  Eigen::VectorXd right = Eigen::VectorXd::Zero(count);
  for (const auto& [c, number] : cells) {
    const FaceRidges& around = mesh.fracture_cells[c].ridges;
    const Eigen::MatrixXd drop = drops.drops(mesh, c);
    const auto sign = [&](int ridge) { return mesh.ridges[ridge].cells[0] == c ? 1.0 : -1.0; };
    for (int k = 0; k < static_cast<int>(around.size()); ++k) {
      const int row = ridges.at(around[k]);
      matrix(number, row) = sign(around[k]);
      matrix(row, number) = sign(around[k]);
      for (int j = 0; j < static_cast<int>(around.size()); ++j)
        matrix(row, ridges.at(around[j])) -= sign(around[k]) * drop(k, j) * sign(around[j]);
      const std::vector<int>& beside = mesh.ridges[around[k]].cells;
      const bool is_rim = !is_inside(around[k]) || !cells.contains(beside[0]) || !cells.contains(beside[1]);
      if (is_rim) right[row] = -sign(around[k]) * std::log((mesh.ridges[around[k]].center - at).norm());
    }
  }
  for (const auto& [c, share] : shares) right[cells.at(c)] = 2 * M_PI * share;
  const Eigen::VectorXd solution = DenseLu(matrix).solve(right);
  double pressure = 0;
  for (const auto& [c, share] : shares) pressure += share * solution[cells.at(c)];
  return std::exp(-pressure);
}

}  // namespace sprekk::fracture_flow
