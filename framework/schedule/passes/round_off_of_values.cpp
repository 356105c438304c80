#include "framework/schedule/passes/round_off_of_values.hpp"

#include <cmath>

#include "framework/invariants.hpp"
#include "framework/parallel/parallel.hpp"
#include "framework/round_off.hpp"

namespace sprekk {

Vector round_off_of_values(const Assembly& assembly, const BlockSystem& system) {
  SPREKK_EXPECT(assembly.wants_derivatives());
  Vector sizes = Vector::Zero(system.size()), own = sizes;
  for (const Assembly::Block& block : assembly.blocks()) {
    const std::vector<char>& owned = system.owned(block.row);
    const Vector& x = assembly.unknowns()[block.column]->now();
    const int first = system.first(block.row);
    for (int row = 0; row < block.matrix->outerSize(); ++row) {
      if (!owned[row]) continue;
      const double scale = block.weights ? block.factor * (*block.weights)[row] : block.factor;
      for (SparseMatrix::InnerIterator entry(*block.matrix, row); entry; ++entry) {
        sizes[first + row] += std::abs(scale * entry.value() * x[entry.col()]);
        if (block.row == block.column && entry.col() == row) own[first + row] += scale * entry.value();
      }
    }
  }
  for (int i = 0; i < sizes.size(); ++i) sizes[i] = own[i] == 0 ? 0 : rounding::of_sum * sizes[i] / std::abs(own[i]);
  parallel::sum(sizes);
  SPREKK_ASSERT(is_finite(sizes), sizes.size());
  return sizes;
}

}  // namespace sprekk
