// The apertures of the half cells at a junction of fractures.
#pragma once

#include <Eigen/Core>
#include <algorithm>
#include <vector>

#include "components/fracture_flow/tpfa/half_cell_apertures.hpp"

namespace sprekk::fracture_flow {

/// The aperture of a half cell at a junction, and its derivatives by the apertures of all cells there.
struct ArmAperture {
  double value;
  Eigen::VectorXd by_aperture;
};

/// The opening of a fracture is linear through a junction, from its cell on one side to that on the other
/// (half_cell_apertures); the same holds for two fractures of which one continues the other. The openings of other arms
/// are independent of one another, since the rock between them may rotate and slide: their half cells have the aperture
/// of the cell, which is of second order. Since a closed arm would then never let fluid in, each opening at a junction
/// is at least a tenth of the widest one there. By the cubic law a closed arm then conducts a thousandth of the widest
/// one: this hardly changes the flow through other arms, and affects only half a cell of the closed arm. But an arm of
/// one cell between two junctions consists of two such half cells, so it conducts a thousandth; with a smaller
/// `mesh.fracture_size` it is closed.
///
/// `partners`: for each cell the place of the cell on the other side, or -1.
inline std::vector<ArmAperture> junction_apertures(const std::vector<CellAperture>& cells,
                                                   const std::vector<int>& partners) {
  constexpr double least_share = 0.1;  // of the widest arm: a conductance of a thousandth
  const int count = static_cast<int>(cells.size());
  const int widest = static_cast<int>(
      std::max_element(cells.begin(), cells.end(),
                       [](const CellAperture& a, const CellAperture& b) { return a.opening < b.opening; }) -
      cells.begin());
  std::vector<ArmAperture> arms;
  for (int i = 0; i < count; ++i) {
    ArmAperture arm{cells[i].aperture, Eigen::VectorXd::Unit(count, i)};
    if (partners[i] >= 0) {
      const HalfCellAperture half = half_cell_apertures(cells[i], cells[partners[i]])[0];
      arm.value = half.value;
      arm.by_aperture[i] = half.by_aperture[0];
      arm.by_aperture[partners[i]] = half.by_aperture[1];
    }
    // In iterates all openings may be negative: then the least aperture is the initial one.
    const double initial = cells[i].aperture - cells[i].opening, share = cells[widest].opening > 0 ? least_share : 0;
    if (const double least = initial + share * cells[widest].opening; arm.value < least) {
      arm.value = least;
      arm.by_aperture = share * Eigen::VectorXd::Unit(count, widest);
    }
    arms.push_back(std::move(arm));
  }
  return arms;
}

}  // namespace sprekk::fracture_flow
