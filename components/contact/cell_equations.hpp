// The equations of a cell, which follow from its trial state.
#pragma once

#include <vector>

#include "framework/types.hpp"

namespace sprekk::contact {

struct Trial;

/// The residual of the equations of a cell, m, and its derivatives by the traction (m/Pa) and by the jump; the normal
/// component first.
struct CellEquations {
  Point residual = Point::Zero();
  Tensor by_traction = Tensor::Zero(), by_jump = Tensor::Zero();
};

/// The data of the equations of a cell besides its trial state and its traction.
struct CellSettings {
  double normal_stiffness, tangential_stiffness;    ///< c, Pa/m, positive
  double normal_compliance, tangential_compliance;  ///< of springs between the walls, m/Pa; 0 where there are none
  bool weakens;                                     ///< whether the strength depends on slip, or on its path
};

/// The equations of a cell with this traction, Pa, whose trial is given (FrictionalContact has the formulas).
CellEquations equations_of(const Trial& trial, const Point& traction, const CellSettings& settings);

/// A square block for each cell.
using CellBlocks = std::vector<Tensor>;
/// Which entries of each block the matrix stores, zeros among them, so that the sparsity of the system never changes:
/// all, or all but those of the normal row by tangential components.
enum class Pattern { full, normal_by_normal };
/// The matrix with these blocks on its diagonal.
SparseMatrix block_diagonal(const CellBlocks& blocks, Pattern pattern);

}  // namespace sprekk::contact
