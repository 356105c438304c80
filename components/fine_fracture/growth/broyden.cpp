#include "components/fine_fracture/growth/broyden.hpp"

namespace sprekk::fine_fracture {

namespace {

constexpr double least_effect = 1e-6;  ///< of the largest effect: the effect of an unknown counts as at least this
constexpr double least_fresh = 0.1;    ///< of a move: with a smaller part normal to earlier moves these are forgotten

}  // namespace

/// The effect of one unit of each unknown on the residual: in these units updates treat all unknowns alike.
Eigen::VectorXd Broyden::effects() const {
  const Eigen::VectorXd norms = jacobian.colwise().norm().transpose();
  return norms.cwiseMax(least_effect * norms.maxCoeff());
}

void Broyden::update(const Eigen::VectorXd& moved, const Eigen::VectorXd& change) {
  if (moved.squaredNorm() == 0) return;
  if (learnt_.empty()) scale_ = effects();
  Eigen::VectorXd scaled = scale_.cwiseProduct(moved), fresh = scaled;
  for (const Eigen::VectorXd& direction : learnt_) fresh -= fresh.dot(direction) * direction;
  if (fresh.norm() < least_fresh * scaled.norm()) {
    learnt_.clear();
    scale_ = effects();
    scaled = fresh = scale_.cwiseProduct(moved);
  }
  if (fresh.squaredNorm() == 0) return;
  const Eigen::VectorXd missed = change - jacobian * moved;
  jacobian += missed * fresh.cwiseProduct(scale_).transpose() / fresh.dot(scaled);
  learnt_.push_back(fresh.normalized());
}

}  // namespace sprekk::fine_fracture
