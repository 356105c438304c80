// The part of Trilinos that Sprekk uses: distributed matrices, multigrid cycles and GMRES.
#pragma once

#include <functional>
#include <memory>
#include <vector>

#include "framework/linear/linear_solver.hpp"

namespace sprekk {

/// A sparse matrix whose rows, and whose operand, are distributed over the processes (Tpetra).
class DistributedMatrix {
 public:
  virtual ~DistributedMatrix() = default;
  /// y -= A x on this process's entries. Collective.
  virtual void subtract_product(const Vector& x, Vector& y) const = 0;
};

/// An algebraic multigrid cycle for one block of unknowns: a linear, fixed operator.
class Multigrid {
 public:
  virtual ~Multigrid() = default;
  /// x = one cycle for b, on this process's rows. Collective.
  virtual void apply(const Vector& b, Vector& x) const = 0;
};

/// Right-preconditioned GMRES (Belos) for one matrix.
class Gmres {
 public:
  /// A solution, converged or not.
  struct Result {
    Vector x;  ///< on this process's rows
    int iterations;
  };
  virtual ~Gmres() = default;
  /// Solves A x = b, from x = 0, until the residual is `tolerance` times that of the start. Collective. Throws
  /// std::exception where the method breaks down.
  virtual Result solve(const Vector& b, double tolerance, int max_iterations) const = 0;
};

/// The module "trilinos", which loads a hundred libraries. Each call is collective and needs MPI: see `trilinos()`.
class TrilinosModule {
 public:
  virtual ~TrilinosModule() = default;
  /// Makes a distributed matrix. `rows`: this process's rows, with global columns. `row_ids`, `column_ids`: global
  /// numbers of the entries of the result, and of the operand, that this process holds.
  virtual std::unique_ptr<DistributedMatrix> matrix(const SparseMatrix& rows, const std::vector<int>& row_ids,
                                                    const std::vector<int>& column_ids, int row_count) const = 0;
  /// Smoothed aggregation (MueLu) with Gauss-Seidel smoothing; rigid-body modes span the near-null space of
  /// elasticity. `rows`: this process's rows of the block, columns counted from the block's first unknown. `ids`: their
  /// numbers. Throws std::invalid_argument if this process holds only some components of an entity.
  virtual std::unique_ptr<Multigrid> multigrid(const SparseMatrix& rows, const std::vector<int>& ids,
                                               const UnknownBlock& block) const = 0;
  /// `rows`: this process's rows, columns global. `ids`: their numbers. `precondition(r, z)`: z = M r on these rows.
  /// `basis`: the number of vectors that are kept before the method restarts from its best x.
  virtual std::unique_ptr<Gmres> gmres(const SparseMatrix& rows, const std::vector<int>& ids,
                                       std::function<void(const Vector&, Vector&)> precondition, int basis) const = 0;
};

/// Opens the module and starts MPI, at the first call. Throws std::runtime_error if it cannot be opened.
const TrilinosModule& trilinos();

}  // namespace sprekk
