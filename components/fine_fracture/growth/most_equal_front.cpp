#include "components/fine_fracture/growth/most_equal_front.hpp"

#include <algorithm>
#include <cmath>

#include "framework/invariants.hpp"

namespace sprekk::fine_fracture {

namespace {

constexpr double half_used = 0.2;       ///< d, increments: the difference of advances at which H is half of 2e
constexpr double least_advance = 1e-9;  ///< increments, of all tips: below, all have the same weight
constexpr double nearly_found = 20;     ///< errors between two loads: where they differ more, weights count as fixed

double beyond(double difference, double error) {
  return std::copysign(std::max(0.0, std::abs(difference) - 2 * error), difference);
}

double held(double ahead, double error) { return 2 * error * ahead / (std::abs(ahead) + half_used); }

/// dH, or its chord.
double slope_of_held(double ahead, double error, bool is_chord) {
  const double distance = std::abs(ahead) + half_used;
  return 2 * error / distance * (is_chord ? 1 : half_used / distance);
}

bool has_advance(const Eigen::VectorXd& advances) { return advances.sum() > least_advance; }

Eigen::VectorXd weights_of(const Eigen::VectorXd& advances) {
  const double count = static_cast<double>(advances.size());
  if (!has_advance(advances)) return Eigen::VectorXd::Constant(advances.size(), 1 / count);
  return advances / advances.sum();
}

}  // namespace

FrontEquations most_equal_front(const Eigen::VectorXd& loads, const Eigen::VectorXd& advances, double mesh_error) {
  SPREKK_EXPECT(loads.size() == advances.size(), loads.size(), advances.size());
  SPREKK_EXPECT(mesh_error >= 0, mesh_error);
  const Eigen::Index count = loads.size();
  if (mesh_error == 0 || count <= 1)
    return {loads, Eigen::VectorXd::Zero(count), Eigen::MatrixXd::Identity(count, count),
            Eigen::MatrixXd::Zero(count, count)};

  const Eigen::VectorXd weights = weights_of(advances);
  const bool moves_weights = has_advance(advances) && loads.maxCoeff() - loads.minCoeff() < nearly_found * mesh_error;
  FrontEquations front{Eigen::VectorXd::Constant(count, weights.dot(loads)), Eigen::VectorXd::Zero(count),
                       Eigen::VectorXd::Ones(count) * weights.transpose(), Eigen::MatrixXd::Zero(count, count)};
  for (Eigen::Index i = 0; i < count; ++i) {
    Eigen::VectorXd drive(count);  // of pairs
    for (Eigen::Index j = 0; j < count; ++j) {
      const double more = loads[i] - loads[j], ahead = advances[i] - advances[j];
      const bool is_beyond = std::abs(more) > 2 * mesh_error;
      drive[j] = beyond(more, mesh_error) - held(ahead, mesh_error);
      if (is_beyond) {
        front.by_load(i, i) += weights[j];
        front.by_load(i, j) -= weights[j];
      }
      const double slope = slope_of_held(ahead, mesh_error, !is_beyond);
      front.by_advance(i, i) -= weights[j] * slope;
      front.by_advance(i, j) += weights[j] * slope;
    }
    front.difference[i] = weights.dot(drive);
    front.residual[i] += front.difference[i];
    if (moves_weights)
      front.by_advance.row(i) +=
          (loads + drive - Eigen::VectorXd::Constant(count, front.residual[i])).transpose() / advances.sum();
  }
  return front;
}

double load_beside_front(double load, const Eigen::VectorXd& loads, const Eigen::VectorXd& advances,
                         double mesh_error) {
  if (mesh_error == 0 || loads.size() == 0 || !has_advance(advances)) return load;
  const Eigen::VectorXd weights = weights_of(advances);
  double value = 0;
  for (Eigen::Index j = 0; j < loads.size(); ++j)
    value += weights[j] * (loads[j] + beyond(load - loads[j], mesh_error) + held(advances[j], mesh_error));
  return value;
}

double load_of_front_at_rest(const Eigen::VectorXd& loads, double mesh_error) {
  SPREKK_EXPECT(loads.size() > 0);
  double sum = 0;
  int count = 0;
  for (const double load : loads)
    if (load >= loads.maxCoeff() - 2 * mesh_error) sum += load, ++count;
  return sum / count;
}

bool advances_are_equal(const Eigen::VectorXd& loads, double mesh_error) {
  return loads.maxCoeff() - loads.minCoeff() <= 2 * mesh_error;
}

}  // namespace sprekk::fine_fracture
