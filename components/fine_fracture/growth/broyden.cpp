#include "components/fine_fracture/growth/broyden.hpp"

namespace sprekk::fine_fracture {

namespace {

constexpr double least_fresh = 0.1;  ///< of a move: what is left of it across earlier ones, to learn from

}  // namespace

void Broyden::update(const Eigen::VectorXd& moved, const Eigen::VectorXd& change) {
  if (moved.squaredNorm() == 0) return;
  Eigen::VectorXd fresh = moved;
  for (const Eigen::VectorXd& direction : learnt_) fresh -= fresh.dot(direction) * direction;
  if (fresh.norm() < least_fresh * moved.norm()) {
    learnt_.clear();
    fresh = moved;
  }
  const Eigen::VectorXd missed = change - jacobian * moved;
  jacobian += missed * fresh.transpose() / fresh.dot(moved);
  learnt_.push_back(fresh.normalized());
}

}  // namespace sprekk::fine_fracture
