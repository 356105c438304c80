// The parts of a system for a preconditioner: unknowns on fractures are solved for exactly, and eliminated from the
// blocks of the bulk approximately.
#pragma once

#include <vector>

#include "framework/linear/direct/umfpack_solver.hpp"
#include "framework/linear/linear_solver.hpp"

namespace sprekk {

/// A block of the system for a multigrid cycle, or (the last part of a partition) all local unknowns together.
struct SystemPart {
  UnknownBlock block;           ///< what a multigrid may know; without a name for the local part
  bool has_fractures = false;   ///< whether potentials on fractures are among those of the bulk
  std::vector<int> unknowns;    ///< global numbers of all unknowns of the part, ascending
  std::vector<int> owned;       ///< places in `unknowns` of those whose rows this process holds
  std::vector<int> owned_rows;  ///< their places among this process's rows
};

/// The parts of a system: bulk parts in the order of block Gauss-Seidel, scalar before elasticity, and then the local
/// part (maybe empty), which also has the unknowns that belong to no block. A scalar block with its stabilization
/// approximates the Schur complement of the elastic block, so it is solved first. Where the bulk has the potentials of
/// one owner alone, they are one part with those on fractures (of which balances are kept): a fracture that conducts
/// well makes the potential nearly constant over its length, which only a multigrid of both sees. Displacements
/// of middles of edges at tips alone are local: as a part of their own, they would take three times as many iterations.
struct Partition {
  explicit Partition(const LinearSystem& system);
  std::vector<SystemPart> parts;
  std::vector<int> part_of, place_of;  ///< of every unknown
  const SystemPart& local() const { return parts.back(); }
};

/// Rows of this process in part `rows`, columns of all unknowns of part `columns`.
SparseMatrix sub_matrix(const SparseMatrix& owned_rows, const Partition& partition, int rows, int columns);

/// With F the local unknowns and B a bulk part: A_FF^-1, on every process alike, and A_BF D^-1 A_FB, where D has the
/// blocks of A_FF between unknowns at the same fracture cell. The second matrix joins the two walls of a fracture that
/// sticks, and is as sparse as the stencil there. It leaves out the coupling along a fracture, which the exact A_FF^-1
/// has.
class LocalElimination {
 public:
  /// Collective, as factor is.
  LocalElimination(const LinearSystem& system, const Partition& partition);
  /// `solved` is false if A_FF is singular. An unknown whose row has no entry in A_FF, as a rate at a point with a
  /// given potential, has that of the Schur complement, -A_FB diag(A_BB)^-1 A_BF. `diagonals`: of A_BB, in the
  /// rows that this process holds, by parts.
  LinearReport factor(const LinearSystem& system, const Partition& partition, const std::vector<Vector>& diagonals);
  void solve(Vector& local) const {
    if (local.size() > 0) solver_.solve_unchecked(local);
  }
  /// -A_BF D^-1 A_FB for the rows of part `bulk` that this process holds. Throws std::invalid_argument if the block of
  /// D of tips is singular.
  SparseMatrix correction(const LinearSystem& system, const Partition& partition, int bulk);
  /// The places in part `bulk` of its unknowns that have a column in A_FB, ascending; on every process alike.
  std::vector<int> beside(const Partition& partition, int bulk) const;

 private:
  std::vector<char> with_refining(const LinearSystem& system, const Partition& partition) const;
  std::vector<Triplet> answers_together(const SparseMatrix& columns);

  UmfpackSolver solver_;
  std::vector<int> together_;  ///< those that refine displacements, and those of cells with them: one block of D
  UmfpackSolver together_solver_;
  bool has_factors_ = false;    ///< of that block
  SparseMatrix rows_;           ///< the rows of all local unknowns, all columns of the system; on every process
  SparseMatrix local_;          ///< of these the local columns, A_FF
  SparseMatrix cell_inverses_;  ///< D^-1
};

}  // namespace sprekk
