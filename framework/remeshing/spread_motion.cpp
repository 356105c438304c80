#include "framework/remeshing/spread_motion.hpp"

#include <Eigen/SparseCholesky>
#include <algorithm>
#include <cmath>
#include <stdexcept>

#include "framework/invariants.hpp"

namespace sprekk {

std::vector<Point> spread_motion(const std::vector<Point>& nodes, const std::vector<std::array<int, 2>>& edges,
                                 const std::vector<bool>& is_at_rest, const std::vector<MovedNode>& moved) {
  SPREKK_EXPECT(is_at_rest.size() == nodes.size(), is_at_rest.size(), nodes.size());
  std::vector<Point> motion(nodes.size(), Point::Zero());
  std::vector<bool> is_given = is_at_rest;
  for (const auto& [node, by] : moved) {
    motion[node] = by;
    is_given[node] = true;
  }
  constexpr int given = -1;
  std::vector<int> unknown(nodes.size(), given);
  int count = 0;
  for (std::size_t node = 0; node < nodes.size(); ++node)
    if (!is_given[node]) unknown[node] = count++;
  if (count == 0 || moved.empty()) return motion;

  Eigen::Array<double, Eigen::Dynamic, dimension> moving(moved.size(), dimension);
  for (std::size_t i = 0; i < moved.size(); ++i) moving.row(i) = nodes[moved[i].node].transpose().array();
  const auto distance_to_moved = [&moving](const Point& x) {
    return std::sqrt((moving.rowwise() - x.transpose().array()).square().rowwise().sum().minCoeff());
  };
  using Matrix = Eigen::SparseMatrix<double>;
  std::vector<Triplet> entries;
  Eigen::Matrix<double, Eigen::Dynamic, dimension> loads = decltype(loads)::Zero(count, dimension);
  for (const auto& [a, b] : edges) {
    if (unknown[a] == given && unknown[b] == given) continue;
    const double weight = 1 / distance_to_moved(0.5 * (nodes[a] + nodes[b]));
    for (const auto& [one, other] : {std::array{a, b}, std::array{b, a}}) {
      if (unknown[one] == given) continue;
      entries.emplace_back(unknown[one], unknown[one], weight);
      if (unknown[other] != given) {
        entries.emplace_back(unknown[one], unknown[other], -weight);
      } else {
        loads.row(unknown[one]) += weight * motion[other].transpose();
      }
    }
  }
  Matrix laplacian(count, count);
  laplacian.setFromTriplets(entries.begin(), entries.end());
  const Eigen::SimplicialLDLT<Matrix> factors(laplacian);
  if (factors.info() != Eigen::Success) throw std::runtime_error("nodes that are not connected to any that is at rest");
  const decltype(loads) solution = factors.solve(loads);
  for (std::size_t node = 0; node < nodes.size(); ++node)
    if (unknown[node] != given) motion[node] = solution.row(unknown[node]).transpose();
  return motion;
}

}  // namespace sprekk
