// The fluxes around one node: the local problem of the MPFA-O method.
#pragma once

#include <Eigen/Core>
#include <array>
#include <vector>

#include "components/matrix_flow/flux_operators.hpp"
#include "framework/discretization/interaction_region.hpp"
#include "framework/discretization/subface.hpp"

namespace sprekk::matrix_flow {

/// Solves the local problem of an interaction region. The pressure is linear in every subcell; pressures agree at the
/// continuity points, and fluxes agree on the subfaces (Aavatsmark 2002, sec. 3). Coefficients are with respect to the
/// pressures of the region's subcells, and then the values of its subfaces with one cell (boundary values for whole
/// faces). The value of a face with a given pressure is the pressure at its continuity point.
///
/// No flow of a region gains energy: the sum over subcells of flux times pressure drop is not negative. For triangles,
/// parallelograms, tetrahedra, parallelepipeds and wedges with parallel edges the choice of the continuity points
/// (continuity_point) ensures this for any tensor. Where other cells violate it, the local problem is changed (see
/// Stabilizer).
class LocalFluxes {
 public:
  /// The change of a local problem that would gain energy. `points`: other continuity points. `damping`: for the part
  /// of the pressures that is not linear, the symmetric fluxes of `blend` are used. Both stay exact for linear
  /// pressures. `blend`: all fluxes are mixed with fluxes that are symmetric and positive definite in each subcell;
  /// these are exact for linear pressures only in the cells that are named above.
  enum class Stabilizer { none, points, damping, blend };

  /// Whether by_mobility is to be called.
  enum class Derivatives { none, by_mobility };
  explicit LocalFluxes(Derivatives derivatives = Derivatives::none) : derivatives_(derivatives) {}

  /// Throws std::runtime_error if the local system is singular.
  Stabilizer solve(const Mesh& mesh, int node, const InteractionRegion& region, const std::vector<Tensor>& mobility,
                   const std::vector<FlowCondition>& conditions);

  /// The pressure at the continuity point of a subface.
  const double* pressure(int subface) const { return pressures_.data() + subface * columns_; }
  /// The flux through a subface out of its first cell (m^2/s; m^3/s in three dimensions).
  const double* flux(int subface) const { return fluxes_.data() + subface * columns_; }
  /// The changes of the fluxes through all subfaces, and of the pressures at them, when the mobility of a subcell
  /// changes by `change` (m^2/(Pa s)), for columns with the values `given`. Stabilizers are held.
  struct Change {
    std::vector<double> flux, pressure;  ///< m^2/s, Pa
  };
  void by_mobility(const InteractionRegion& region, const std::vector<FlowCondition>& conditions, int subcell,
                   const Tensor& change, const std::vector<double>& given, Change& result) const;
  int columns() const { return columns_; }
  /// The point of a subface where the pressures of both sides agree; a stabilizer may have moved it from
  /// continuity_point.
  const ContinuityPoint& point(int subface) const { return points_[subface]; }

 private:
  using Matrix = Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor>;
  /// Fluxes into a subcell, by its pressure drops.
  using Weights = std::array<std::array<double, dimension>, dimension>;

  void find_arms(const Mesh& mesh, const InteractionRegion& region);
  Weights consistent(const Subcell& subcell, const Tensor& mobility, int k) const;
  Weights symmetric(const Subcell& subcell, const Tensor& mobility, int k) const;
  using WeightsOf = Weights (LocalFluxes::*)(const Subcell&, const Tensor&, int) const;
  void solve_with(WeightsOf weights_of, const Mesh& mesh, const InteractionRegion& region,
                  const std::vector<Tensor>& mobility, const std::vector<FlowCondition>& conditions);
  Stabilizer stabilize(const Mesh& mesh, int node, const InteractionRegion& region, const std::vector<Tensor>& mobility,
                       const std::vector<FlowCondition>& conditions);
  bool each_subcell_dissipates() const;
  bool dissipates(const InteractionRegion& region, const std::vector<FlowCondition>& conditions) const;
  Matrix dissipation(const InteractionRegion& region, const std::vector<FlowCondition>& conditions) const;
  /// The jumps of the gradient along the inner subfaces (one in a plane, two directions in space), times the length of
  /// these subfaces, Pa.
  Matrix kinks(const Mesh& mesh, int node, const InteractionRegion& region) const;

  Derivatives derivatives_;
  int subfaces_ = 0, columns_ = 0;
  std::vector<double> system_, pressures_, fluxes_;
  std::vector<ContinuityPoint> points_;                 ///< of the subfaces
  std::vector<std::array<Point, dimension>> arm_;       ///< of the subcells, from the centre to the points, m
  std::vector<std::array<Point, dimension>> gradient_;  ///< of the subcells, as Subcell::gradient
  std::vector<Weights> weights_;                        ///< of the subcells
  WeightsOf weights_of_ = nullptr;                      ///< that gave these
  std::vector<int> side_;                               ///< of each subface, 0 or 1, from which its flux is computed
  std::vector<double> inverse_;  ///< subfaces × subfaces: pressures by fluxes that enter; with Derivatives::by_mobility
};

}  // namespace sprekk::matrix_flow
