#include "framework/linear/direct/mumps_solver.hpp"

#include <dmumps_c.h>
#include <mpi.h>

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <deque>
#include <utility>
#include <vector>

#include "framework/invariants.hpp"
#include "framework/linear/direct/kept_orderings.hpp"
#include "framework/linear/direct/near_singular.hpp"
#include "framework/linear/expect_sound.hpp"
#include "framework/linear/refined_solve.hpp"
#include "framework/linear/stopwatch.hpp"
#include "framework/linear/unknown_names.hpp"
#include "framework/parallel/gathered.hpp"
#include "framework/parallel/parallel.hpp"
#include "framework/parallel/row_exchange.hpp"

namespace sprekk {
namespace {

enum Job { end_instance = -2, start_instance = -1, analyse = 1, factorize = 2, solve_for_columns = 3 };

bool have_same_pattern(const SparseMatrix& a, const SparseMatrix& b) {
  return a.rows() == b.rows() && a.cols() == b.cols() && a.nonZeros() == b.nonZeros() &&
         std::equal(a.outerIndexPtr(), a.outerIndexPtr() + a.rows() + 1, b.outerIndexPtr()) &&
         std::equal(a.innerIndexPtr(), a.innerIndexPtr() + a.nonZeros(), b.innerIndexPtr());
}

/// Powers of two that scale the largest entries of a border to 2^-10: MUMPS compares pivots with all entries of a row,
/// and the entries of the border should not affect the choice of pivots.
Vector scales_of_border(const Vector& largest) {
  return largest.unaryExpr([](double size) {
    int exponent = 0;
    std::frexp(size, &exponent);
    return size > 0 ? std::ldexp(1.0, -10 - exponent) : 1.0;
  });
}

}  // namespace

/// The indices of parameters are those of the MUMPS 5.5 users' guide.
struct MumpsSolver::Instance {
  DMUMPS_STRUC_C data{};
  std::vector<int> rows, columns;  ///< of the entries of this process, counted from one
  std::vector<double> values;      ///< of the matrix and its border
  std::vector<int> border;         ///< the numbers of the unknowns that are not eliminated
  std::vector<double> schur;       ///< their Schur complement, by rows
  std::vector<int> pivots;         ///< the unknowns, from 0 on, of which this process gets the solution
  bool has_pivots = false;         ///< since the factorization
  std::unique_ptr<parallel::RowExchange> solution_to_rows;  ///< from those to the rows of this process
  std::unique_ptr<parallel::WholeVectors> solution_to_all;  ///< from those to all unknowns
  bool is_ordered = false;                                  ///< for these entries

  Instance() {
    parallel::start_mpi();
    data.sym = 0;
    data.par = 1;
    data.comm_fortran = MPI_Comm_c2f(MPI_COMM_WORLD);
    run(start_instance);
    for (int stream = 1; stream <= 3; ++stream) icntl(stream) = -1;  // errors, warnings, statistics: quiet
    icntl(4) = 0;
    icntl(5) = 0;    // an assembled matrix
    icntl(6) = 0;    // no permutation of columns
    icntl(8) = 0;    // no scaling: the matrix is scaled already
    icntl(10) = 0;   // no refinement: refined_solve uses the true residual
    icntl(14) = 30;  // per cent of spare room
    const bool is_distributed = parallel::size() > 1;
    icntl(18) = is_distributed ? 3 : 0;   // entries on every process
    icntl(20) = is_distributed ? 10 : 0;  // a dense right-hand side, its rows on every process
    icntl(21) = is_distributed ? 1 : 0;   // the solution on the processes that have the pivots
    icntl(24) = 1;                        // detects pivots that are zero to rounding, and continues
    icntl(26) = 0;                        // solves for the eliminated unknowns
  }
  ~Instance() {
    int is_finalized = 0;
    MPI_Finalized(&is_finalized);
    if (is_finalized == 0) run(end_instance);
  }
  Instance(const Instance&) = delete;
  Instance& operator=(const Instance&) = delete;

  /// Tells MUMPS where the entries are.
  void point_to_entries() {
    const auto count = static_cast<MUMPS_INT8>(rows.size());
    if (parallel::size() > 1) {
      data.nnz_loc = count;
      data.irn_loc = rows.data();
      data.jcn_loc = columns.data();
    } else {
      data.nnz = count;
      data.irn = rows.data();
      data.jcn = columns.data();
    }
  }
  int& icntl(int number) { return data.icntl[number - 1]; }
  int status() const { return data.infog[0]; }
  void run(Job job) {
    data.job = job;
    dmumps_c(&data);
  }
};

/// Instances of solvers that were destroyed, for new solvers with the same pattern.
struct MumpsSolver::Orderings {
  static constexpr std::size_t most = 3;         ///< the newest ones: of settling, and of a step
  static constexpr int largest_system = 10'000;  ///< rows: an instance keeps the memory of its factors
  int scopes = 0;                                ///< objects of KeptOrderings
  std::deque<std::unique_ptr<Instance>> kept;

  void keep(std::unique_ptr<Instance> instance) {
    if (scopes == 0 || !instance->is_ordered || instance->data.n > largest_system) return;
    kept.push_back(std::move(instance));
    if (kept.size() > most) kept.pop_front();
  }
  /// Replaces an instance by one that has been ordered for the same entries on every process, if there is one.
  bool take_for(std::unique_ptr<Instance>& instance) {
    const auto same = std::ranges::find_if(kept, [&](const auto& other) {
      return !parallel::any(other->border != instance->border || other->rows != instance->rows ||
                            other->columns != instance->columns);
    });
    if (same == kept.end()) return false;
    instance = std::move(*same);
    kept.erase(same);
    return true;
  }
};

KeptOrderings::KeptOrderings() { ++MumpsSolver::orderings().scopes; }

KeptOrderings::~KeptOrderings() {
  if (--MumpsSolver::orderings().scopes == 0) MumpsSolver::orderings().kept.clear();
}

MumpsSolver::Orderings& MumpsSolver::orderings() {
  static thread_local Orderings orderings;
  return orderings;
}

MumpsSolver::MumpsSolver() : mumps_(std::make_unique<Instance>()) { use_one_blas_thread(); }
MumpsSolver::~MumpsSolver() { orderings().keep(std::move(mumps_)); }

LinearReport MumpsSolver::factor(const LinearSystem& system) {
  expect_sound(system);
  if (!system.local.isCompressed()) {
    LinearSystem compressed = system;
    compressed.local.makeCompressed();
    return factor(compressed);
  }
  const Change change = take(system);
  if (change == Change::nothing) {
    ++counts_.reused;
    return last_report_;
  }
  const bool had_border = border_.size() > 0;
  border_ = {};
  return factor_scaled(change == Change::pattern || had_border);
}

std::optional<LinearReport> MumpsSolver::factor_bordered(const LinearSystem& system, const SparseMatrix& columns,
                                                         const SparseMatrix& rows, Eigen::MatrixXd& schur) {
  if (parallel::any(!system.local.isCompressed())) return std::nullopt;
  expect_sound(system);
  SPREKK_EXPECT(columns.rows() == system.local.rows(), columns.rows(), system.local.rows());
  SPREKK_EXPECT(rows.cols() == system.local.cols(), rows.cols(), system.local.cols());
  const Change change = take(system);
  Border border = scaled(columns, rows);
  const bool has_new_pattern =
      parallel::any(change == Change::pattern || !have_same_pattern(border.columns, border_.columns) ||
                    !have_same_pattern(border.rows, border_.rows));
  border_ = std::move(border);
  const LinearReport report = factor_scaled(has_new_pattern);
  if (!report.solved) return report;
  SPREKK_ASSERT(std::max(rows.rows(), columns.cols()) <= border_.size(), rows.rows(), columns.cols(), border_.size());
  SPREKK_ASSERT(mumps_->schur.size() == static_cast<std::size_t>(border_.size()) * border_.size());
  schur.resize(rows.rows(), columns.cols());
  const int size = border_.size();
  for (int row = 0; row < schur.rows(); ++row)
    for (int column = 0; column < schur.cols(); ++column)
      schur(row, column) = -mumps_->schur[static_cast<std::size_t>(row) * size + column] /
                           (border_.row_scale[row] * border_.column_scale[column]);
  return report;
}

/// Remembers the system and scales it, if it is a new one.
Change MumpsSolver::take(const LinearSystem& system) {
  const Change change = last_.compare_and_remember(system);
  if (change == Change::nothing) return change;
  system_.rows = system.rows;
  system_.blocks = system.blocks;
  const Stopwatch watch(counts_.seconds_factor);
  scaled_ = equilibrate(system);
  return change;
}

MumpsSolver::Border MumpsSolver::scaled(const SparseMatrix& columns, const SparseMatrix& rows) {
  const Stopwatch watch(counts_.seconds_factor);
  Border border{scaled_.row_scale.asDiagonal() * columns, rows * scaled_.column_scale.asDiagonal(), {}, {}};
  Vector largest_of_column = Vector::Zero(columns.cols()), largest_of_row = Vector::Zero(rows.rows());
  for (int row = 0; row < columns.rows(); ++row)
    for (SparseMatrix::InnerIterator entry(border.columns, row); entry; ++entry)
      largest_of_column[entry.col()] = std::max(largest_of_column[entry.col()], std::abs(entry.value()));
  parallel::max(largest_of_column);
  for (int row = 0; row < rows.rows(); ++row)
    for (SparseMatrix::InnerIterator entry(border.rows, row); entry; ++entry)
      largest_of_row[row] = std::max(largest_of_row[row], std::abs(entry.value()));
  border.column_scale = scales_of_border(largest_of_column);
  border.row_scale = scales_of_border(largest_of_row);
  border.columns = border.columns * border.column_scale.asDiagonal();
  border.rows = border.row_scale.asDiagonal() * border.rows;
  return border;
}

LinearReport MumpsSolver::factor_scaled(bool has_new_pattern) {
  last_report_ = scaled_.mistake.empty() ? LinearReport::success() : LinearReport::failure(scaled_.mistake);
  if (last_report_.solved && has_new_pattern) last_report_ = order();
  if (last_report_.solved) last_report_ = factor_values();
  // After an error an instance of MUMPS must not be used again. A singular matrix is no error in this sense, and its
  // ordering is kept.
  if (!last_report_.solved && (mumps_->status() < 0 || !scaled_.mistake.empty())) {
    mumps_->is_ordered = false;
    last_.forget();
    border_ = {};
  }
  return last_report_;
}

void MumpsSolver::list_entries() {
  std::vector<int>&rows = mumps_->rows, &columns = mumps_->columns;
  rows.clear();
  columns.clear();
  auto entries = static_cast<std::size_t>(scaled_.matrix.nonZeros() + border_.columns.nonZeros());
  if (parallel::is_root()) entries += border_.rows.nonZeros() + border_.size();
  rows.reserve(entries);
  columns.reserve(entries);
  const auto list = [&](const SparseMatrix& a, const auto& number_of_row, int first_column) {
    for (int row = 0; row < a.rows(); ++row)
      for (SparseMatrix::InnerIterator entry(a, row); entry; ++entry) {
        rows.push_back(number_of_row(row) + 1);
        columns.push_back(first_column + static_cast<int>(entry.col()) + 1);
      }
  };
  const int n = static_cast<int>(scaled_.matrix.cols());
  list(
      scaled_.matrix, [&](int row) { return system_.rows[row]; }, 0);
  list(
      border_.columns, [&](int row) { return system_.rows[row]; }, n);
  mumps_->border.clear();
  if (!parallel::is_root()) return;
  list(
      border_.rows, [n](int row) { return n + row; }, 0);
  for (int k = 0; k < border_.size(); ++k) {
    mumps_->border.push_back(n + k + 1);
    rows.push_back(n + k + 1);
    columns.push_back(n + k + 1);
  }
}

/// The values of the entries of list_entries().
double* MumpsSolver::list_values() {
  if (border_.size() == 0) return scaled_.matrix.valuePtr();
  std::vector<double>& values = mumps_->values;
  values.clear();
  const auto add = [&](const SparseMatrix& a) {
    values.insert(values.end(), a.valuePtr(), a.valuePtr() + a.nonZeros());
  };
  add(scaled_.matrix);
  add(border_.columns);
  if (!parallel::is_root()) return values.data();
  add(border_.rows);
  values.resize(values.size() + border_.size(), 0.0);
  return values.data();
}

LinearReport MumpsSolver::order() {
  const Stopwatch watch(counts_.seconds_ordering);
  list_entries();
  const int size = static_cast<int>(scaled_.matrix.cols()) + border_.size();
  if (!mumps_->is_ordered && orderings().take_for(mumps_) && mumps_->data.n == size) return LinearReport::success();
  mumps_->is_ordered = false;
  auto& data = mumps_->data;
  SPREKK_ASSERT(mumps_->rows.size() == mumps_->columns.size(), mumps_->rows.size(), mumps_->columns.size());
  data.n = size;
  mumps_->point_to_entries();
  mumps_->icntl(19) = border_.size() > 0 ? 1 : 0;
  data.size_schur = border_.size();
  data.listvar_schur = mumps_->border.data();
  // Minimum degree costs a third of nested dissection, and gives as little fill for small matrices. With a border,
  // nested dissection is not available in Debian's MUMPS.
  constexpr int minimum_degree = 0, its_own_choice = 7, worth_dissecting = 10'000;
  const bool is_small = parallel::size() == 1 && data.n < worth_dissecting;
  mumps_->icntl(7) = is_small || border_.size() > 0 ? minimum_degree : its_own_choice;
  data.a = nullptr;  // the analysis needs no values, and those of the last matrix may not exist any more
  mumps_->run(analyse);
  ++counts_.orderings;
  mumps_->is_ordered = mumps_->status() >= 0;
  if (mumps_->status() == -6) return LinearReport::failure("the matrix is singular (its pattern alone shows it)");
  if (mumps_->status() < 0)
    return LinearReport::failure("the analysis of MUMPS failed with status " + std::to_string(mumps_->status()));
  return LinearReport::success();
}

LinearReport MumpsSolver::factor_values() {
  const Stopwatch watch(counts_.seconds_factor);
  if (mumps_->rows.empty()) {
    list_entries();
    mumps_->point_to_entries();
  }
  (parallel::size() > 1 ? mumps_->data.a_loc : mumps_->data.a) = list_values();
  mumps_->schur.resize(static_cast<std::size_t>(border_.size()) * border_.size());
  mumps_->data.schur = mumps_->schur.data();
  // A pivot is zero only where nothing is left of it: small ones are a matter of scales, and looked at below.
  constexpr double zero_alone = -1e-200;  // negative: an absolute threshold
  mumps_->data.cntl[2] = zero_alone;
  const int spare = mumps_->icntl(14);
  // Pivoting may need more room than the analysis foresaw (-9: the main array, -8, -17, -20: buffers).
  constexpr int most_attempts = 6;  // 32 times the room in the end
  for (int attempt = 0; attempt < most_attempts; ++attempt) {
    mumps_->run(factorize);
    const int status = mumps_->status();
    if (status != -9 && status != -8 && status != -17 && status != -20) break;
    mumps_->icntl(14) *= 2;
  }
  ++counts_.factorizations;
  // They are read by factorizations alone, and take as much memory as the values of the matrix.
  if (mumps_->data.n > Orderings::largest_system) {
    mumps_->rows = std::vector<int>();
    mumps_->columns = std::vector<int>();
    mumps_->point_to_entries();
  }
  mumps_->has_pivots = false;
  const int status = mumps_->status();
  if (status < 0) mumps_->icntl(14) = spare;
  if (status < 0)
    return LinearReport::failure("the factorization of MUMPS failed with status " + std::to_string(status));
  if (parallel::size() > 1)
    MPI_Bcast(mumps_->schur.data(), static_cast<int>(mumps_->schur.size()), MPI_DOUBLE, 0, MPI_COMM_WORLD);
  return not_singular();
}

LinearReport MumpsSolver::not_singular() {
  if (mumps_->data.infog[27] > 0) {  // the number of zero pivots; their list is on the root
    int row = parallel::is_root() ? mumps_->data.pivnul_list[0] : 0;
    MPI_Bcast(&row, 1, MPI_INT, 0, MPI_COMM_WORLD);
    return LinearReport::failure("the matrix is singular (a zero pivot in the row of " +
                                 describe_unknown(system_.blocks, row - 1) + ")");
  }
  const std::string reason = find_singularity(system_, scaled_.matrix, [this](Vector& v) { make_whole_inverse(v); });
  return reason.empty() ? LinearReport::success() : LinearReport::failure(reason);
}

LinearReport MumpsSolver::solve(const Vector& b_rows, Vector& x) {
  if (!last_report_.solved) return last_report_;
  const Stopwatch watch(counts_.seconds_solve);
  ++counts_.solves;
  return refined_solve(
      system_, scaled_, b_rows, [this](Vector& v) { make_whole_inverse(v); }, x);
}

bool MumpsSolver::solve_columns(Eigen::Ref<Eigen::MatrixXd> columns) {
  SPREKK_EXPECT(columns.rows() == scaled_.matrix.rows(), columns.rows(), scaled_.matrix.rows());
  const Stopwatch watch(counts_.seconds_solve);
  counts_.columns += static_cast<int>(columns.cols());
  constexpr int together = 32;  // several columns together are faster; all together would double the memory
  const Vector scale_of_solution = scaled_.column_scale(system_.rows);
  mumps_->icntl(9) = 1;
  for (Eigen::Index first = 0; first < columns.cols(); first += together) {
    auto some = columns.middleCols(first, std::min<Eigen::Index>(together, columns.cols() - first));
    Eigen::MatrixXd block = scaled_.row_scale.asDiagonal() * some;
    back_substitute(block);
    some = scale_of_solution.asDiagonal() * block;
  }
  return true;
}

/// Solves in place for several columns, given on this process's rows. Rows of the border are zero.
void MumpsSolver::back_substitute(Eigen::MatrixXd& columns) {
  auto& data = mumps_->data;
  data.nrhs = static_cast<int>(columns.cols());
  if (parallel::size() > 1) {
    const Eigen::MatrixXd solution = solution_at_pivots(columns);
    if (!mumps_->solution_to_rows)
      mumps_->solution_to_rows = std::make_unique<parallel::RowExchange>(mumps_->pivots, system_.rows);
    columns = mumps_->solution_to_rows->moved(solution);
    return;
  }
  const Eigen::Index unknowns = columns.rows();
  columns.conservativeResizeLike(Eigen::MatrixXd::Zero(data.n, columns.cols()));
  data.rhs = columns.data();
  data.lrhs = data.n;
  mumps_->run(solve_for_columns);
  columns.conservativeResize(unknowns, columns.cols());
}

/// The rows of the solution at the unknowns that this process eliminates. Collective.
Eigen::MatrixXd MumpsSolver::solution_at_pivots(Eigen::MatrixXd& columns) {
  auto& data = mumps_->data;
  data.nrhs = static_cast<int>(columns.cols());
  std::vector<int> rows = system_.rows, solved(data.info[22]);
  for (int& row : rows) ++row;
  Eigen::MatrixXd solution(solved.size(), columns.cols());
  data.nloc_rhs = data.lrhs_loc = static_cast<int>(rows.size());
  data.irhs_loc = rows.data();
  data.rhs_loc = columns.data();
  data.lsol_loc = static_cast<int>(solved.size());
  data.isol_loc = solved.data();
  data.sol_loc = solution.data();
  mumps_->run(solve_for_columns);
  for (int& unknown : solved) --unknown;
  // Pivots stay as long as the factors.
  if (!std::exchange(mumps_->has_pivots, true) && parallel::any(solved != mumps_->pivots)) {
    mumps_->pivots = std::move(solved);
    mumps_->solution_to_rows.reset();
    mumps_->solution_to_all.reset();
  }
  return solution;
}

/// The whole of A^-1 v, from this process's rows of v.
void MumpsSolver::make_whole_inverse(Vector& v) {
  Eigen::MatrixXd column = v;
  if (parallel::size() == 1) {
    back_substitute(column);
    v = column;
    return;
  }
  const Vector solution = solution_at_pivots(column);
  if (!mumps_->solution_to_all)  // without the unknowns of the border
    mumps_->solution_to_all =
        std::make_unique<parallel::WholeVectors>(mumps_->pivots, static_cast<int>(scaled_.matrix.cols()));
  v = mumps_->solution_to_all->whole(solution);
}

}  // namespace sprekk
