// Checks of the systems that solvers get.
#pragma once

#include "framework/invariants.hpp"
#include "framework/linear/linear_solver.hpp"

namespace sprekk {

/// In builds with assertions: rows in ascending order, a row of the matrix for each, indices of columns, blocks and
/// sums in range, places and stabilizations of the right length.
inline void expect_sound([[maybe_unused]] const LinearSystem& system) {
#ifdef SPREKK_ASSERTIONS
  const SparseMatrix& a = system.local;
  SPREKK_EXPECT(static_cast<int>(system.rows.size()) == a.rows(), system.rows.size(), a.rows());
  SPREKK_EXPECT(are_indices(system.rows, a.cols()), a.cols());
  SPREKK_EXPECT(is_ascending(system.rows));
  SPREKK_EXPECT(a.rows() <= a.cols(), a.rows(), a.cols());
  SPREKK_EXPECT(!a.isCompressed() || is_well_formed(a), a.rows(), a.cols(), a.nonZeros());
  SPREKK_EXPECT(are_indices(system.sums, a.cols()), a.cols());
  for (const UnknownBlock& block : system.blocks) {
    const int size = block.entities * block.components;
    SPREKK_EXPECT(block.entities >= 0 && block.components > 0, block.name, block.entities, block.components);
    SPREKK_EXPECT(block.first >= 0 && block.first + size <= a.cols(), block.name, block.first, size, a.cols());
    SPREKK_EXPECT(block.coordinates.size() == 0 || block.coordinates.cols() == block.entities, block.name,
                  block.coordinates.cols(), block.entities);
    SPREKK_EXPECT(block.stabilization.size() == 0 || block.stabilization.size() == size, block.name,
                  block.stabilization.size(), size);
    SPREKK_EXPECT(is_finite(block.stabilization), block.name);
  }
#endif
}

}  // namespace sprekk
