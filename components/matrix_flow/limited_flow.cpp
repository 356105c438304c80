// The nonlinear part of fluxes, where the discretization has one.
#include <algorithm>
#include <cmath>
#include <limits>

#include "components/matrix_flow/buoyancy.hpp"
#include "components/matrix_flow/limited_fluxes.hpp"
#include "components/matrix_flow/matrix_flow.hpp"
#include "framework/invariants.hpp"
#include "framework/mesh/cell_sums.hpp"
#include "framework/parallel/parallel.hpp"

namespace sprekk::matrix_flow {

void MatrixFlow::use_limited() {
  const auto& [first, second] = operators_.limited;
  for (const OneSidedFluxOperators& side : operators_.limited) {
    SPREKK_ASSERT(side.cell.rows() == mesh_.face_count() && side.cell.cols() == mesh_.cell_count(), side.cell.rows());
    SPREKK_ASSERT(side.boundary.rows() == mesh_.face_count() && is_finite(side.cell), side.boundary.rows());
  }
  const SparseMatrix mean =
      cell_sums(mesh_, operators_.flux_cell + 0.5 * first.cell + 0.5 * second.cell, 1, parallel::rank());
  for (int row = 0; row < mean.rows(); ++row)
    largest_conductance_ = std::max(largest_conductance_, mean.row(row).cwiseAbs().sum());
}

void MatrixFlow::add_limited(Flow& flow, const Vector& potential, const Vector& wall_flux, const Vector& side_outflow,
                             const Vector& excess) const {
  std::array<Vector, 2> sides;
  for (const int side : {0, 1}) {
    sides[side] = operators_.limited[side].cell * potential + limited_constant_[side];
    if (wall_flux.size() > 0) sides[side] += limited_of_wall_flux_[side] * wall_flux;
    // Limited flows have no other border than their leaky sides.
    if (side_outflow.size() > 0) sides[side] += borders_.front().limited[side] * side_outflow;
    if (excess.size() > 0)
      sides[side] += buoyancy_->limited()[side].cells * excess + buoyancy_->limited()[side].of_boundaries;
  }
  largest_limited_ = std::max(sides[0].lpNorm<Eigen::Infinity>(), sides[1].lpNorm<Eigen::Infinity>());
  LimitedFluxes limited = limit(sides[0], sides[1], rounding_);
  flow.fluxes += limited.value;
  flow.by_first = std::move(limited.by_first);
  flow.by_second = std::move(limited.by_second);
}

void MatrixFlow::round_limited(double rounding) {
  if (rounding == rounding_) return;
  rounding_ = rounding;
  forget_flow();
}

void MatrixFlow::set_search_mode(SearchMode mode) {
  search_by_state(mode);
  if (!is_limited_ || is_sealed_) return;
  round_limited(mode == SearchMode::piecewise_linear    ? std::numeric_limits<double>::infinity()
                : mode == SearchMode::without_shortcuts ? with_secants
                                                        : 0);
  rounding_at_first_ = 0;
}

void MatrixFlow::release_coefficients(double share) {
  if (share == 0) return set_search_mode(SearchMode::piecewise_linear);
  if (by_state_) release_by_state(share);
  if (!is_limited_ || is_sealed_) return;
  constexpr double decades = 14;  // from the largest flux to its round-off
  if (rounding_at_first_ == 0) {
    flow(State::now);
    rounding_at_first_ = parallel::max(largest_limited_);
  }
  round_limited(share == 1 ? 0 : rounding_at_first_ * std::pow(10, -decades * share));
}

SparseMatrix MatrixFlow::limited_derivative(const Flow& flow, const SparseMatrix& first, const SparseMatrix& second) {
  return SparseMatrix(flow.by_first.asDiagonal() * first) + SparseMatrix(flow.by_second.asDiagonal() * second);
}

void MatrixFlow::assemble_limited(Assembly& assembly, const Flow& flow, double dt) const {
  if (!assembly.wants_derivatives()) return;
  // Fluxes through inner faces alone: nothing of them is left in the sum of all rows.
  const auto add = [&](const Field& column, const SparseMatrix& first, const SparseMatrix& second) {
    if (!assembly.has_row(column)) return;
    assembly.exchange_derivative(pressure_, column,
                                 cell_sums(mesh_, dt * limited_derivative(flow, first, second), 1, parallel::rank()));
  };
  add(pressure_, operators_.limited[0].cell, operators_.limited[1].cell);
  if (wall_flux_) add(*wall_flux_, limited_of_wall_flux_[0], limited_of_wall_flux_[1]);
  if (side_outflow_) add(*side_outflow_, borders_.front().limited[0], borders_.front().limited[1]);
}

}  // namespace sprekk::matrix_flow
