// An algebraic multigrid cycle for one block of unknowns.
#pragma once

#include <memory>
#include <vector>

#include "framework/linear/linear_solver.hpp"

namespace sprekk {

/// Smoothed aggregation (MueLu) with symmetric Gauss-Seidel smoothing; rigid-body modes span the near-null space of
/// elasticity. A linear, fixed operator.
class Multigrid {
 public:
  /// `rows`: this process's rows of the block, columns counted from the block's first unknown. `ids`: their numbers.
  /// Collective. Throws std::invalid_argument if this process holds only some components of an entity.
  Multigrid(const SparseMatrix& rows, const std::vector<int>& ids, const UnknownBlock& block);
  ~Multigrid();
  /// x = one cycle for b, on this process's rows. Collective.
  void apply(const Vector& b, Vector& x) const;

 private:
  struct Data;
  std::unique_ptr<Data> data_;
};

}  // namespace sprekk
