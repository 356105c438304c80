// Linear solvers behind one interface, for one process or several.
#pragma once

#include <cstdint>
#include <memory>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "framework/linear/block_kind.hpp"
#include "framework/types.hpp"

namespace sprekk {

/// What solvers may know of one block of unknowns.
struct UnknownBlock {
  std::string name;  ///< of the field, "rock.displacement"
  int first = 0;     ///< first unknown
  int entities = 0;  ///< cells, fracture cells, …; unknowns are entity-major: first + entity * components + c
  int components = 1;
  BlockKind kind = BlockKind::interface;
  Eigen::MatrixXd coordinates = {};  ///< a column an entity, m, for rigid-body modes and partitioning; or empty
  Vector stabilization;   ///< one an unknown: diagonal to add to the block in a preconditioner or split (fixed stress),
                          ///< or empty
  bool may_store = true;  ///< whether its rows may be balances; false where it is known that they are not

  bool has_coordinates() const { return entities > 0 && coordinates.cols() == entities; }
  /// Whether both have their unknowns at the same places.
  bool is_at_places_of(const UnknownBlock& other) const {
    return has_coordinates() && other.has_coordinates() && coordinates.rows() == other.coordinates.rows() &&
           coordinates.cols() == other.coordinates.cols() && coordinates == other.coordinates;
  }
  /// Whether rigid rotations are motions without force.
  bool can_turn() const {
    return kind == BlockKind::bulk_elastic && has_coordinates() && components == coordinates.rows();
  }
};

/// A square system of which this process holds some rows. `rows` are global row numbers in ascending order; column
/// indices of `local` are global. In a single process `rows` is 0 … n-1.
struct LinearSystem {
  std::vector<int> rows;
  SparseMatrix local;
  std::vector<UnknownBlock> blocks;
  /// Rows (of all processes) that are sums of balances: their small entries are not round-off of large ones.
  std::vector<int> sums;
  /// Numbers that spare solvers a comparison of all entries. Two systems with the same pattern number, not 0, have the
  /// same rows, blocks (without stabilizations), sums and sparsity pattern on this process. Two systems with the same
  /// `number`, not 0, are the same.
  std::uint64_t pattern_number = 0, number = 0;
};

/// A number that no system has had, for LinearSystem::number and pattern_number.
std::uint64_t new_system_number();

/// How a factorization or a solve ended.
struct LinearReport {
  bool solved = false;
  std::string reason;            ///< why not
  int iterations = 0;            ///< of an iterative method
  double relative_residual = 0;  ///< ||b - A x|| / ||b|| after the solve, in the solver's own (equilibrated) scaling

  static LinearReport success() {
    LinearReport report;
    report.solved = true;
    return report;
  }
  static LinearReport failure(std::string why) {
    LinearReport report;
    report.reason = std::move(why);
    return report;
  }
};

/// Counts and times of a solver's work since it was made, and of work that it could skip.
struct LinearCounts {
  int orderings = 0;       ///< symbolic analyses of a new pattern
  int factorizations = 0;  ///< numeric factorizations, or preconditioner set-ups
  int reused = 0;          ///< calls of `factor` with bitwise the last system: nothing done
  int solves = 0;          ///< right-hand sides
  int iterations = 0;      ///< of an iterative method, all solves together
  int condensed = 0;       ///< factorizations of a condensed system (CondensedSolver), instead of the whole one
  int columns = 0;         ///< right-hand sides that were solved together, to condense
  int patterns = 0;        ///< sparsity patterns built by those who assemble the systems
  int assemblies = 0;      ///< states that were assembled
  double seconds_ordering = 0, seconds_factor = 0, seconds_solve = 0;
  double seconds() const { return seconds_ordering + seconds_factor + seconds_solve; }
  LinearCounts& operator+=(const LinearCounts& other) {
    orderings += other.orderings;
    factorizations += other.factorizations;
    reused += other.reused;
    solves += other.solves;
    iterations += other.iterations;
    condensed += other.condensed;
    columns += other.columns;
    patterns += other.patterns;
    assemblies += other.assemblies;
    seconds_ordering += other.seconds_ordering;
    seconds_factor += other.seconds_factor;
    seconds_solve += other.seconds_solve;
    return *this;
  }
};

/// A solver of linear systems. It reuses earlier work: a new matrix with the same sparsity pattern reuses the ordering,
/// bitwise the same system reuses the factorization.
class LinearSolver {
 public:
  virtual ~LinearSolver() = default;
  /// Factorizes (or sets up a preconditioner for) the system. Collective. Returns a report with `solved` false and a
  /// reason, naming the block and entity if it can, for a singular matrix.
  virtual LinearReport factor(const LinearSystem& system) = 0;
  /// Solves for one right-hand side, given on this process's rows; `x` becomes the whole solution on every process.
  /// The true residual is checked after every solve; direct solvers reduce it by iterative refinement where needed.
  virtual LinearReport solve(const Vector& b_rows, Vector& x) = 0;
  /// Solves A X = B in place for the columns of B, given on this process's rows, without a check of residuals.
  /// Collective. False for a solver that does not offer this.
  virtual bool solve_columns(Eigen::Ref<Eigen::MatrixXd> /*columns*/) { return false; }
  /// Factorizes A as `factor` does, and computes R A^-1 C (r × c) in the same factorization: the Schur complement,
  /// without its sign, of a border of columns C (this process's rows × c) and rows R (r × n, whole on every process, as
  /// the result). This costs less than the columns of A^-1 C. Returns std::nullopt, and has done nothing, for a solver
  /// that does not offer this.
  virtual std::optional<LinearReport> factor_bordered(const LinearSystem& /*system*/, const SparseMatrix& /*columns*/,
                                                      const SparseMatrix& /*rows*/, Eigen::MatrixXd& /*schur*/) {
    return std::nullopt;
  }
  virtual std::string name() const = 0;
  virtual const LinearCounts& counts() const { return counts_; }

 protected:
  LinearCounts counts_;
};

/// What it costs to condense a bulk of n unknowns onto f interface unknowns, in factorizations of the bulk: f / columns
/// for the columns of A_BB^-1 A_BF, and (f / (width n^power))^3 for the dense part of each reduced system
/// (docs/performance.md, "What condensing costs").
struct CondensingCosts {
  double columns = 200, columns_at_once = 700;  ///< at_once: they come with the factorization
  double width = 7, power = 0.5;                ///< in a plane, from 4,000 to 250,000 unknowns
  /// The cost of columns, over what a system saves, up to which a bulk is condensed at once; others wait for as many
  /// systems. The number of systems for which a bulk will stay is unknown; it is about three, those of one step, or
  /// more. Compared with the best choice, condensing at once costs at most (1 + C) / 3 times as much, if the bulk stays
  /// for three systems only; waiting for C systems first costs at most (1 + 2 C) / (1 + C) times as much, if the bulk
  /// stays longer. Both are equal at C = 2 + sqrt(6).
  double worth_at_once = 4.4;
};

/// Parameters of the linear solver: those of a scene's `solver:`, and what the schedule knows.
struct LinearOptions {
  std::string type = "auto";  ///< auto, umfpack, mumps, belos
  double tolerance = 1e-10;   ///< relative residual of iterative methods: as the direct solvers' `acceptable`
  int max_iterations = 500;   ///< five restarts of the longest kind
  bool condense = true;       ///< direct solvers: factorize the bulk once, and then only its Schur complement
  /// Whether the bulk changes after a few systems, as where the mesh changes with the steps. Then the time of
  /// factorizations matters more than that of back-solves.
  bool bulk_changes_often = false;
  /// Unknowns up to which `auto` takes a direct solver. In a plane memory is the limit. In space factors fill far more:
  /// one of 50,000 unknowns takes as long as 60 solves by GMRES, and ten times as many are out of reach.
  int largest_for_direct = 600'000;
  /// Unknowns up to which `auto` solves a system directly if GMRES does not converge. In a plane there is no size
  /// beyond `largest_for_direct`: memory is the limit.
  int largest_for_direct_instead = 0;
  CondensingCosts condensing = {};
};

/// `auto`: UMFPACK for small systems in one process, MUMPS for larger ones, where the bulk changes often and in several
/// processes, Belos with the block preconditioner above a size.
/// Throws std::invalid_argument for an unknown type, and for umfpack on several processes.
std::unique_ptr<LinearSolver> make_linear_solver(const LinearOptions& options);
/// Whether make_linear_solver gives a direct solver for a system of this size.
bool is_direct(const LinearOptions& options, int unknowns);
/// The solver for Newton's method. Direct solvers condense the bulk if the options say so (CondensedSolver); in one
/// process they solve decoupled blocks apart (SeparatedSolver). With Belos this is make_linear_solver.
std::unique_ptr<LinearSolver> make_condensing_solver(const LinearOptions& options);

/// The name of the BLAS in use, and whether it is the slow reference implementation.
struct BlasInfo {
  std::string name;
  bool is_reference;
};
BlasInfo blas_in_use();  ///< asks the library that is loaded
/// Limits BLAS to one thread. Solvers call this before their first factorization: threads inside OpenBLAS gain nothing
/// on the small fronts of two-dimensional problems, and their number would change the rounding.
void use_one_blas_thread();

}  // namespace sprekk
