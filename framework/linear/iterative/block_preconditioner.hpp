// The block preconditioner of elliptic and elastic blocks that are coupled, with unknowns on interfaces.
#pragma once

#include <memory>
#include <optional>
#include <vector>

#include "framework/linear/iterative/local_elimination.hpp"
#include "framework/linear/linear_solver.hpp"
#include "framework/linear/trilinos_module/trilinos_module.hpp"
#include "framework/parallel/gathered.hpp"

namespace sprekk {

/// An approximate inverse M of the system: the triangular fixed-stress preconditioner (White, Castelletto and Tchelepi
/// 2016). The unknowns F on the fractures are eliminated exactly. One sweep of block Gauss-Seidel follows on the bulk
/// blocks that remain, with a multigrid cycle for each: elliptic blocks, with the diagonals that stabilize them
/// (UnknownBlock), before elastic ones. M is linear and fixed, so plain GMRES may use it.
class BlockPreconditioner {
 public:
  /// Collective. `system` must outlive the constructor only. Throws std::invalid_argument if a process holds a part of
  /// an entity's components, or the fracture unknowns cannot be eliminated.
  explicit BlockPreconditioner(const LinearSystem& system);
  /// z = M r on this process's rows. Collective.
  void apply(const Vector& r, Vector& z) const;

 private:
  struct Coupling {
    int column_part;
    std::unique_ptr<DistributedMatrix> matrix;
  };
  Vector without_couplings(int part, const Vector& r, const std::vector<Vector>& solutions) const;
  Vector solve_local(Vector owned) const;

  std::vector<std::vector<int>> owned_rows_;        ///< of every part
  std::vector<std::vector<Coupling>> couplings_;    ///< of every part's rows with other parts
  std::vector<std::unique_ptr<Multigrid>> cycles_;  ///< of every bulk part
  std::optional<LocalElimination> elimination_;
  std::vector<int> local_owned_;
  parallel::WholeVectors whole_local_;
  int local_unknowns_ = 0;
};

}  // namespace sprekk
