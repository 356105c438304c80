#include "framework/remeshing/spread_motion.hpp"

#include <Eigen/SparseCholesky>
#include <algorithm>
#include <cmath>
#include <stdexcept>

#include "framework/invariants.hpp"
#include "framework/mesh/mesh.hpp"

namespace sprekk {

namespace {

using Loads = Eigen::Matrix<double, Eigen::Dynamic, dimension>;

}  // namespace

struct SpreadMotion::Equations {
  /// What the motion of a node that is given adds to the equation of another one.
  struct Given {
    int unknown, node;
    double weight;
  };
  int count = 0;
  std::vector<Given> given;
  Eigen::SimplicialLDLT<Eigen::SparseMatrix<double>> factors;
};

SpreadMotion::SpreadMotion(const std::vector<Point>& nodes, const std::vector<std::array<int, 2>>& edges,
                           const std::vector<bool>& is_at_rest, const std::vector<int>& moved)
    : is_moved_(nodes.size(), 0), unknown_(nodes.size(), none) {
  SPREKK_EXPECT(is_at_rest.size() == nodes.size(), is_at_rest.size(), nodes.size());
  for (const int node : moved) is_moved_[node] = 1;
  auto equations = std::make_unique<Equations>();
  int& count = equations->count;
  for (std::size_t node = 0; node < nodes.size(); ++node)
    if (!is_at_rest[node] && !is_moved_[node]) unknown_[node] = count++;
  if (count > 0 && !moved.empty()) {
    Eigen::Array<double, Eigen::Dynamic, dimension> moving(moved.size(), dimension);
    for (std::size_t i = 0; i < moved.size(); ++i) moving.row(i) = nodes[moved[i]].transpose().array();
    const auto distance_to_moved = [&moving](const Point& x) {
      return std::sqrt((moving.rowwise() - x.transpose().array()).square().rowwise().sum().minCoeff());
    };
    std::vector<Triplet> entries;
    for (const auto& [a, b] : edges) {
      if (unknown_[a] == none && unknown_[b] == none) continue;
      const double weight = 1 / distance_to_moved(0.5 * (nodes[a] + nodes[b]));
      for (const auto& [one, other] : {std::array{a, b}, std::array{b, a}}) {
        if (unknown_[one] == none) continue;
        entries.emplace_back(unknown_[one], unknown_[one], weight);
        if (unknown_[other] != none)
          entries.emplace_back(unknown_[one], unknown_[other], -weight);
        else if (is_moved_[other])
          equations->given.push_back({unknown_[one], other, weight});
      }
    }
    Eigen::SparseMatrix<double> laplacian(count, count);
    laplacian.setFromTriplets(entries.begin(), entries.end());
    equations->factors.compute(laplacian);
    if (equations->factors.info() != Eigen::Success)
      throw std::runtime_error("nodes that are not connected to any that is at rest");
  }
  equations_ = std::move(equations);
}

SpreadMotion::~SpreadMotion() = default;

std::vector<Point> SpreadMotion::of(const std::vector<MovedNode>& moved) const {
  std::vector<Point> motion(unknown_.size(), Point::Zero());
  for (const auto& [node, by] : moved) {
    SPREKK_EXPECT(is_moved_[node], node);
    motion[node] = by;
  }
  if (equations_->count == 0 || moved.empty()) return motion;
  Loads loads = Loads::Zero(equations_->count, dimension);
  for (const auto& [unknown, node, weight] : equations_->given) loads.row(unknown) += weight * motion[node].transpose();
  const Loads solution = equations_->factors.solve(loads);
  for (std::size_t node = 0; node < unknown_.size(); ++node)
    if (unknown_[node] != none) motion[node] = solution.row(unknown_[node]).transpose();
  return motion;
}

std::vector<Point> spread_motion(const std::vector<Point>& nodes, const std::vector<std::array<int, 2>>& edges,
                                 const std::vector<bool>& is_at_rest, const std::vector<MovedNode>& moved) {
  std::vector<int> of;
  for (const MovedNode& node : moved) of.push_back(node.node);
  return SpreadMotion(nodes, edges, is_at_rest, of).of(moved);
}

}  // namespace sprekk
