// The discrete equations of the flow in some cells, with given pressures in the cells around them.
#pragma once

#include <functional>
#include <vector>

#include "components/capabilities/fluid_fluxes.hpp"
#include "framework/linear/direct/sparse_lu.hpp"
#include "framework/mesh/mesh.hpp"

namespace sprekk::couplers {

/// Outflows of `cells` in rock of one mobility, m^2/(Pa s).
class PatchOfCells {
 public:
  /// Throws std::invalid_argument, with the reason, for a discretization with unknowns on faces, and for one with
  /// nonlinear fluxes.
  PatchOfCells(const Mesh& mesh, const MatrixFluxes& fluxes, std::vector<int> cells, const Tensor& mobility);

  const std::vector<int>& cells() const { return cells_; }
  /// Whether no flux depends on the pressure of another cell.
  bool is_alone() const { return outside_.empty(); }
  /// The pressures p of the cells, one each, with `storage` · measure · p + outflow(p) = `supply`, and the pressure
  /// `around`(x) in the cells around them, whose centres are x.
  Vector solve(double storage, const Vector& supply, const std::function<double(const Point&)>& around) const;

 private:
  struct Outside {
    int row, point;
    double weight;
  };
  std::vector<int> cells_;
  std::vector<double> measures_;  ///< m^2, in space m^3
  std::vector<Triplet> entries_;
  std::vector<Point> points_;     ///< centres of the cells around, m
  std::vector<Outside> outside_;  ///< pressures there times weights enter the balances of cells
  mutable SparseLu solver_;       ///< keeps the ordering of its first matrix
};

}  // namespace sprekk::couplers
