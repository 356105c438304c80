#include "components/matrix_flow/mpfa/tip_energy.hpp"

#include <array>
#include <map>
#include <vector>

#include "components/matrix_flow/mpfa/local_fluxes.hpp"
#include "components/matrix_flow/mpfa/tip_correction.hpp"
#include "framework/dense/cholesky.hpp"
#include "framework/discretization/interaction_region.hpp"

namespace sprekk::matrix_flow {
namespace {

/// Of the size of the dissipation: what a factorization leaves, and no gain of energy.
constexpr double of_factorization = 1e-11;
/// For the root of an entry without any power: no division by zero.
constexpr double above_zero = 1e-300;
/// Shares of the tip's part of the fluxes, tried in this order: the first that gains no energy is taken.
constexpr std::array parts = {1.0, 0.75, 0.5, 0.25};

/// The power that is lost in all regions of a tip, as a form of the pressures of cells and of what flows through walls
/// (in space also through sides that the rim meets).
class Power {
 public:
  Power(const TipFlow& flow, const Mesh& mesh, const std::vector<int>& nodes) : flow_(flow) {
    const auto number = [](std::map<int, int>& numbers, int item) {
      numbers.emplace(item, static_cast<int>(numbers.size()));
    };
    for (const int cell : flow.cells()) number(cells_, cell);
    for (const int node : nodes) {
      for (const int cell : mesh.node_cells[node]) number(cells_, cell);
      for (const int face : mesh.node_faces[node])
        if (mesh.face_cells[face][1] == none) number(walls_, face);
    }
    linear_ = Eigen::MatrixXd::Zero(size(), size());
    modes_ = Eigen::MatrixX2d::Zero(size(), 2);
  }

  void add(const InteractionRegion& region, const LocalFluxes& local, const TipCorrection& tip) {
    columns_.clear();
    for (const Subcell& subcell : region.subcells) columns_.push_back(cells_.at(subcell.cell));
    for (int f = 0; f < region.subface_count(); ++f)
      if (!region.is_inner(f)) columns_.push_back(place_of_wall(region.faces[f]));
    for (int f = 0; f < region.subface_count(); ++f) {
      const auto [first, second] = region.neighbours[f];
      const double share = region.shares[f];
      if (region.is_inner(f)) {
        const TipFlow::Modes modes = tip.of_flux(f);
        add_row(columns_[first], local.flux(f), modes, 1);
        add_row(columns_[second], local.flux(f), modes, -1);
      } else {
        const int wall = place_of_wall(region.faces[f]);
        linear_(columns_[first], wall) += share;
        add_row(wall, local.pressure(f), tip.of_pressure(f), -share);
      }
    }
  }

  double dissipative_part() const {
    Eigen::MatrixXd added = Eigen::MatrixXd::Zero(size(), size());
    for (std::size_t i = 0; i < flow_.cells().size(); ++i)
      added.col(cells_.at(flow_.cells()[i])) = modes_ * flow_.share().col(i);
    return sprekk::matrix_flow::dissipative_part(linear_, added);
  }

 private:
  int size() const { return static_cast<int>(cells_.size() + walls_.size()); }
  int place_of_wall(int face) const { return static_cast<int>(cells_.size()) + walls_.at(face); }

  void add_row(int row, const double* own, const TipFlow::Modes& modes, double factor) {
    for (const int column : columns_) linear_(row, column) += factor * *own++;
    modes_.row(row) += factor * modes;
  }

  const TipFlow& flow_;
  std::map<int, int> cells_, walls_;
  std::vector<int> columns_;  ///< of the values that enter the local problem of a region
  Eigen::MatrixXd linear_;
  Eigen::MatrixX2d modes_;  ///< what the rows get for each of the two modes, with amounts of 1
};

}  // namespace

double dissipative_part(const Eigen::MatrixXd& linear, const Eigen::MatrixXd& added) {
  const Eigen::VectorXd scale = linear.diagonal().cwiseAbs().cwiseMax(above_zero).cwiseSqrt().cwiseInverse();
  for (const double part : parts) {
    const Eigen::MatrixXd whole = linear + part * added;
    Eigen::MatrixXd form = scale.asDiagonal() * (0.5 * (whole + whole.transpose())) * scale.asDiagonal();
    form.diagonal().array() += of_factorization * static_cast<double>(linear.rows());
    if (DenseCholesky(form).is_positive_definite()) return part;
  }
  return 0;
}

double dissipative_share(const TipFlow& flow, const Mesh& mesh, const std::vector<int>& nodes,
                         const std::vector<Tensor>& mobility, const std::vector<FlowCondition>& conditions) {
  Power power(flow, mesh, nodes);
  InteractionRegion region;
  LocalFluxes local;
  for (const int node : nodes) {
    region.assign(mesh, node);
    local.solve(mesh, node, region, mobility, conditions);
    power.add(region, local, TipCorrection(flow, mesh, region, local, node, mobility, conditions));
  }
  return power.dissipative_part();
}

}  // namespace sprekk::matrix_flow
