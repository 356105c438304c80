#include "components/fine_fracture/growth/learnt_slopes.hpp"

#include <algorithm>
#include <cmath>

#include "framework/invariants.hpp"

namespace sprekk::fine_fracture {

namespace {

// How large the error of an entry of the first Jacobian may be.
/// Of the derivative of the load by the tip's own advance: by 198 trials of the paper's section 5.2.
constexpr double load_by_advance = 0.5;
constexpr double load_by_other_advance = 0.2;        ///< the same, by that of another tip
constexpr double load_by_angle = 0.1;                ///< 1/rad
constexpr double load_by_other_angle = 0.005;        ///< 1/rad
constexpr double direction_by_advance = 0.5;         ///< of the derivative of the load by the tip's own advance
constexpr double direction_by_other_advance = 0.05;  ///< the same, by that of another tip
constexpr double direction_by_angle = 0.1;           ///< of the derivative of the direction by the tip's own angle
constexpr double direction_by_other_angle = 0.003;   ///< the same, by that of another tip
/// Per increment and per rad, in the uncertainties: by second differences in the paper's section 5.2.
constexpr double least_slope = 0.01;
constexpr double curvature = 0.03;   ///< per increment² and rad²: what a Jacobian cannot tell of a residual
constexpr double least_fresh = 0.1;  ///< of the uncertainty: a move with less of it was known from earlier moves
constexpr double surprising = 5;     ///< standard deviations: a row that was so wrong, but known, forgets its moves
constexpr double residual_round_off = 1e-9;  ///< of a residual

}  // namespace

Eigen::VectorXd LearntSlopes::uncertainties(Eigen::Index row) const {
  const Eigen::Index tip = row / 2;
  const bool is_load = row % 2 == 0;
  const double by_advance = std::max(least_slope, std::abs(jacobian(2 * tip, 2 * tip)));
  const double by_angle = std::max(least_slope, std::abs(jacobian(2 * tip + 1, 2 * tip + 1)));
  Eigen::VectorXd values(jacobian.cols());
  for (Eigen::Index other = 0; other < jacobian.cols() / 2; ++other) {
    const bool is_own = other == tip;
    if (is_load) {
      values[2 * other] = (is_own ? load_by_advance : load_by_other_advance) * by_advance;
      values[2 * other + 1] = is_own ? load_by_angle : load_by_other_angle;
    } else {
      values[2 * other] = (is_own ? direction_by_advance : direction_by_other_advance) * by_advance;
      values[2 * other + 1] = (is_own ? direction_by_angle : direction_by_other_angle) * by_angle;
    }
  }
  return values;
}

void LearntSlopes::update(const Eigen::VectorXd& moved, const Eigen::VectorXd& change) {
  SPREKK_EXPECT(moved.size() == jacobian.cols() && change.size() == jacobian.rows(), moved.size(), change.size());
  if (moved.squaredNorm() == 0) return;
  if (covariances_.empty())
    for (Eigen::Index row = 0; row < jacobian.rows(); ++row)
      covariances_.emplace_back(uncertainties(row).cwiseAbs2().asDiagonal());
  const Eigen::VectorXd missed = change - jacobian * moved;
  const double of_squares = curvature * moved.squaredNorm();
  const double of_measurement = of_squares * of_squares + residual_round_off * residual_round_off;
  for (Eigen::Index row = 0; row < jacobian.rows(); ++row) {
    Eigen::MatrixXd& covariance = covariances_[row];
    const Eigen::VectorXd at_first = uncertainties(row).cwiseAbs2().cwiseProduct(moved);
    Eigen::VectorXd shared = covariance * moved;
    double variance = std::max(0.0, moved.dot(shared)) + of_measurement;
    const bool is_known = variance < least_fresh * least_fresh * moved.dot(at_first) + of_measurement;
    if (is_known && std::abs(missed[row]) > surprising * std::sqrt(variance)) {
      covariance = uncertainties(row).cwiseAbs2().asDiagonal();
      shared = at_first;
      variance = moved.dot(at_first) + of_measurement;
    }
    jacobian.row(row) += missed[row] / variance * shared.transpose();
    covariance -= shared * shared.transpose() / variance;
  }
}

}  // namespace sprekk::fine_fracture
