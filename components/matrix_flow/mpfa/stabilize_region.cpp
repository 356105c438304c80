// Interaction regions with quadrilaterals, wedges or hexahedra whose flow would gain energy.
#include <algorithm>
#include <array>

#include "components/matrix_flow/mpfa/local_fluxes.hpp"
#include "framework/dense/svd.hpp"
#include "framework/dense/symmetric_eigen.hpp"

namespace sprekk::matrix_flow {
namespace {

constexpr double round_off = 1e-12;  // of the largest eigenvalue: a smaller negative one gains no energy
/// Of the largest singular value: smaller ones are round-off, not kinks of the pressure.
constexpr double bends = 1e-9;
/// Continuity points on faces, from their middle to the node (continuity_point), in the order of their errors.
constexpr std::array other_points = {0.15, 0.0, 1.0 / 3, 0.5};
/// Factors on the part of the pressures that is not linear, and shares of the symmetric method, from the least change
/// to the largest.
constexpr std::array dampings = {1.0, 2.0, 4.0, 8.0, 16.0};
constexpr std::array shares = {0.125, 0.25, 0.375, 0.5, 0.625, 0.75, 0.875, 1.0};

/// Scales a quadratic form so that its diagonal is 1.
Eigen::VectorXd scale_of(const Eigen::MatrixXd& form) {
  Eigen::VectorXd scale = form.diagonal().cwiseAbs().cwiseSqrt();
  for (double& value : scale) value = value > 0 ? 1 / value : 0;
  return scale;
}

}  // namespace

LocalFluxes::Matrix LocalFluxes::dissipation(const InteractionRegion& region,
                                             const std::vector<FlowCondition>& conditions) const {
  Matrix power = Matrix::Zero(columns_, columns_);
  int column = region.subcell_count();
  for (int f = 0; f < subfaces_; ++f) {
    const Eigen::Map<const Eigen::RowVectorXd> flux(this->flux(f), columns_), pressure(this->pressure(f), columns_);
    const auto [first, second] = region.neighbours[f];
    if (region.is_inner(f)) {
      power.row(first) += flux;
      power.row(second) -= flux;
    } else if (conditions[region.faces[f]] == FlowCondition::flux) {
      power(first, column) += region.shares[f];
      power.row(column++) -= region.shares[f] * pressure;
    } else {
      power.row(first) += flux;
      power.row(column++) -= flux;
    }
  }
  return 0.5 * (power + power.transpose());
}

bool LocalFluxes::each_subcell_dissipates() const {
  return std::all_of(weights_.begin(), weights_.end(), [](const Weights& w) {
    const auto mean = [&](int i, int j) { return 0.5 * (w[i][j] + w[j][i]); };
    const double two = w[0][0] * w[1][1] - mean(0, 1) * mean(0, 1);
    if constexpr (dimension == 2) {
      return w[0][0] > 0 && two > 0;
    } else {
      const double across = mean(0, 1) * mean(1, 2) - w[1][1] * mean(0, 2),
                   beside = w[0][0] * mean(1, 2) - mean(0, 1) * mean(0, 2);
      return w[0][0] > 0 && two > 0 && w[2][2] * two + mean(0, 2) * across - mean(1, 2) * beside > 0;
    }
  });
}

bool LocalFluxes::dissipates(const InteractionRegion& region, const std::vector<FlowCondition>& conditions) const {
  const Matrix power = dissipation(region, conditions);
  const Eigen::VectorXd scale = scale_of(power);
  const Eigen::MatrixXd scaled = scale.asDiagonal() * power * scale.asDiagonal();
  return symmetric_eigenvalues(scaled)[0] >= -round_off * columns_;
}

LocalFluxes::Matrix LocalFluxes::kinks(const Mesh& mesh, int node, const InteractionRegion& region) const {
  constexpr int directions = dimension - 1;
  Matrix kinks = Matrix::Zero(directions * subfaces_, columns_);
  for (int f = 0; f < subfaces_; ++f) {
    if (!region.is_inner(f)) continue;
    const auto along = ways_along_face(mesh, region.faces[f], node);
    for (int row = 0; row < directions; ++row)
      for (int side = 0; side < 2; ++side) {
        const int k = region.neighbours[f][side];
        for (int i = 0; i < dimension; ++i) {
          const double part = (side == 0 ? 1 : -1) * along[row].dot(gradient_[k][i]);
          kinks.row(directions * f + row) +=
              part * Eigen::Map<const Eigen::RowVectorXd>(pressure(region.subcells[k].subfaces[i]), columns_);
          kinks(directions * f + row, k) -= part;
        }
      }
  }
  return kinks;
}

LocalFluxes::Stabilizer LocalFluxes::stabilize(const Mesh& mesh, int node, const InteractionRegion& region,
                                               const std::vector<Tensor>& mobility,
                                               const std::vector<FlowCondition>& conditions) {
  const std::vector<ContinuityPoint> points = points_;
  // Continuity points on walls and sides stay, since all parts of such a face share what is given there.
  for (const double other : other_points) {
    for (int f = 0; f < subfaces_; ++f)
      if (region.is_inner(f)) points_[f].part = other;
    find_arms(mesh, region);
    solve_with(&LocalFluxes::consistent, mesh, region, mobility, conditions);
    if (dissipates(region, conditions)) return Stabilizer::points;
  }
  points_ = points;
  find_arms(mesh, region);
  solve_with(&LocalFluxes::consistent, mesh, region, mobility, conditions);
  const std::vector<double> exact_pressures = pressures_, exact_fluxes = fluxes_;
  const Eigen::MatrixXd kinks = this->kinks(mesh, node, region);
  solve_with(&LocalFluxes::symmetric, mesh, region, mobility, conditions);
  const std::vector<double> symmetric_pressures = pressures_, symmetric_fluxes = fluxes_;
  const Eigen::VectorXd scale = scale_of(dissipation(region, conditions));

  // The part of the pressures that is not linear: orthogonal to all pressures without kinks, in units of equal energy.
  const DenseSvd svd(kinks * scale.asDiagonal(), Eigen::ComputeFullV);
  const auto& size = svd.singularValues();
  const Eigen::MatrixXd turned = svd.matrixV().leftCols((size.array() > bends * size[0]).count());
  const Eigen::MatrixXd bent = scale.asDiagonal() * turned * turned.transpose() * scale.cwiseInverse().asDiagonal();
  const auto map = [this](const std::vector<double>& values) {
    return Eigen::Map<const Matrix>(values.data(), subfaces_, columns_);
  };
  const auto take = [&](const Matrix& pressures, const Matrix& fluxes) {
    Eigen::Map<Matrix>(pressures_.data(), subfaces_, columns_) = pressures;
    Eigen::Map<Matrix>(fluxes_.data(), subfaces_, columns_) = fluxes;
    return dissipates(region, conditions);
  };
  const Eigen::MatrixXd straight = Eigen::MatrixXd::Identity(columns_, columns_) - bent;
  for (const double damping : dampings)
    if (take(map(exact_pressures) * straight + damping * map(symmetric_pressures) * bent,
             map(exact_fluxes) * straight + damping * map(symmetric_fluxes) * bent))
      return Stabilizer::damping;
  for (const double share : shares)
    if (take((1 - share) * map(exact_pressures) + share * map(symmetric_pressures),
             (1 - share) * map(exact_fluxes) + share * map(symmetric_fluxes)))
      return Stabilizer::blend;
  return Stabilizer::blend;
}

}  // namespace sprekk::matrix_flow
