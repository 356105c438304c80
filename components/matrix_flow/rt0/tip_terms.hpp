// The singular flow around tips of fractures in the equations of the cells near them.
#pragma once

#include <Eigen/Core>
#include <map>
#include <vector>

#include "components/matrix_flow/mpfa/tip_flow.hpp"
#include "components/matrix_flow/rt0/flux_mass.hpp"

namespace sprekk::matrix_flow {

/// The term of the flow around a tip in the equations of a cell: M F = p − h + missing · amounts. The amounts of the
/// modes follow from the pressures around the tip (TipFlow::share).
struct TipTerm {
  const TipFlow* flow = nullptr;
  Eigen::Matrix<double, Eigen::Dynamic, 2, 0, most_faces, 2> missing;  ///< Pa for amounts of 1 Pa/m^0.5, one row a face
};

/// The terms of all cells near tips. With piecewise linear pressures alone a fracture exchanges as much fluid as one
/// that is longer or shorter by a part of a cell. So the residual of the two modes of the flow is added to the
/// equations of each cell whose corners all lie near one tip (in space, one rim), with their pressures at the centres
/// of cells and faces and their fluxes in closed form. These terms vanish for linear pressures. As in MPFA, they are
/// reduced where they would gain energy.
class TipTerms {
 public:
  /// `masses`: flux_mass of every cell.
  TipTerms(const Mesh& mesh, const std::vector<Tensor>& mobility, const std::vector<FlowCondition>& conditions,
           const std::vector<FluxMass>& masses);

  const TipTerm* of(int cell) const;  ///< null where there is none

 private:
  std::map<int, TipFlow> flows_;  ///< by tip
  std::map<int, TipTerm> terms_;  ///< by cell
};

}  // namespace sprekk::matrix_flow
