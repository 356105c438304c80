#include "components/matrix_flow/mpfa/tip_flow.hpp"

#include <algorithm>
#include <cmath>

#include "framework/dense/svd.hpp"

namespace sprekk::matrix_flow {
namespace {

/// Of a fit: the constant, the coordinates, and the modes.
constexpr int terms = 1 + dimension + 2;

}  // namespace

bool is_isotropic(const Tensor& mobility) {
  constexpr double rounding = 1e-9;  // relative difference of given components with which rock is isotropic
  const Tensor deviator = mobility - mobility.trace() / dimension * Tensor::Identity();
  return mobility.trace() > 0 && deviator.lpNorm<Eigen::Infinity>() <= rounding * mobility.trace();
}

bool resembles(const Tensor& mobility, const Tensor& other, double alike) {
  return (mobility - other).lpNorm<Eigen::Infinity>() <= alike * other.lpNorm<Eigen::Infinity>();
}

std::optional<TipFlow> TipFlow::find(const Mesh& mesh, int tip, const std::vector<int>& cells,
                                     const std::vector<Tensor>& mobility, const MpfaLimits& limits) {
  if (static_cast<int>(cells.size()) <= terms) return std::nullopt;
  const auto at_tip = mesh.node_cells[tip];
  Tensor mean = Tensor::Zero();
  for (const int cell : at_tip) mean += mobility[cell] / static_cast<double>(at_tip.size());
  for (const int cell : cells)
    if (!(limits.alike_in_region ? mesh.cell_region[cell] == mesh.cell_region[at_tip[0]]
                                 : resembles(mobility[cell], mean, limits.alike)))
      return std::nullopt;
  if (!is_isotropic(mean)) return std::nullopt;
  TipFlow flow(mesh, tip, cells, mean);
  // On a side the cells may all lie in one layer across the rim, so that nothing tells what changes along it.
  for (int coordinates = dimension; coordinates >= 2; --coordinates)
    if (flow.fit(mesh, limits, coordinates)) return flow;
  return std::nullopt;
}

TipFlow::TipFlow(const Mesh& mesh, int tip, const std::vector<int>& cells, const Tensor& mobility)
    : frame_(mesh, tip), mobility_(mobility), cells_(cells) {}

bool TipFlow::fit(const Mesh& mesh, const MpfaLimits& limits, int coordinates) {
  const int count = static_cast<int>(cells_.size()), terms = 1 + coordinates + 2;
  const double size = frame_.size();
  Eigen::MatrixXd basis(count, terms);
  for (int k = 0; k < count; ++k) {
    const Point x = mesh.cell_center[cells_[k]];
    Point local = (x - frame_.origin()) / size;
    if constexpr (dimension == 3) local = (frame_.axes().transpose() * local).eval();
    basis.row(k) << 1, local.head(coordinates).transpose(),
        pressure(x, frame_.side_of_cell(mesh, cells_[k])) / std::sqrt(size);
  }
  const DenseSvd svd(basis, Eigen::ComputeThinU | Eigen::ComputeThinV);
  if (svd.singularValues()[terms - 1] < limits.well_posed * svd.singularValues()[0]) return false;
  const Eigen::MatrixXd inverse = svd.solve(Eigen::MatrixXd::Identity(count, count));
  share_ = inverse.bottomRows<2>() / std::sqrt(size);
  return share_.cwiseAbs().rowwise().sum().maxCoeff() * std::sqrt(size) <= limits.largest_share;
}

TipFlow::Modes TipFlow::pressure(const Point& x, int side) const {
  const auto [radius, angle] = frame_.polar(x, side);
  return std::sqrt(radius) * Modes(std::cos(0.5 * angle), std::sin(0.5 * angle));
}

}  // namespace sprekk::matrix_flow
