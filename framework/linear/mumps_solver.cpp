#include "framework/linear/mumps_solver.hpp"

#include <dmumps_c.h>
#include <mpi.h>

#include <algorithm>
#include <cstdlib>
#include <vector>

#include "framework/linear/near_singular.hpp"
#include "framework/linear/refined_solve.hpp"
#include "framework/linear/stopwatch.hpp"
#include "framework/linear/unknown_names.hpp"
#include "framework/parallel/parallel.hpp"

namespace sprekk {
namespace {

enum Job { end_instance = -2, start_instance = -1, analyse = 1, factorize = 2, back_substitute = 3 };

}  // namespace

/// Parameters carry the numbers of the MUMPS 5.5 users' guide.
struct MumpsSolver::Instance {
  DMUMPS_STRUC_C data{};
  std::vector<int> rows, columns;  ///< of the entries of this process, counted from one

  Instance() {
    parallel::start_mpi();
    data.sym = 0;
    data.par = 1;
    data.comm_fortran = MPI_Comm_c2f(MPI_COMM_WORLD);
    run(start_instance);
    for (int stream = 1; stream <= 3; ++stream) icntl(stream) = -1;  // errors, warnings, statistics: quiet
    icntl(4) = 0;
    icntl(5) = 0;    // an assembled matrix
    icntl(7) = 7;    // an ordering of its own choice
    icntl(8) = 0;    // no scaling: done already
    icntl(10) = 0;   // no refinement: ours looks at the true residual
    icntl(14) = 30;  // per cent of spare room
    icntl(18) = 3;   // entries on every process
    icntl(20) = 0;   // a dense right-hand side on the root
    icntl(21) = 0;   // the solution on the root
    icntl(24) = 1;   // notes pivots that are zero to rounding, and goes on
  }
  ~Instance() {
    int is_finalized = 0;
    MPI_Finalized(&is_finalized);
    if (is_finalized == 0) run(end_instance);
  }
  Instance(const Instance&) = delete;
  Instance& operator=(const Instance&) = delete;

  int& icntl(int number) { return data.icntl[number - 1]; }
  int status() const { return data.infog[0]; }
  void run(Job job) {
    data.job = job;
    dmumps_c(&data);
  }
};

MumpsSolver::MumpsSolver() : mumps_(std::make_unique<Instance>()) { use_one_blas_thread(); }
MumpsSolver::~MumpsSolver() = default;

LinearReport MumpsSolver::factor(const LinearSystem& system) {
  if (!system.local.isCompressed()) {
    LinearSystem compressed = system;
    compressed.local.makeCompressed();
    return factor(compressed);
  }
  const Change change = last_.compare_and_remember(system);
  if (change == Change::nothing) {
    ++counts_.reused;
    return last_report_;
  }
  system_.rows = system.rows;
  system_.blocks = system.blocks;
  system_.sums = system.sums;
  {
    const Stopwatch watch(counts_.seconds_factor);
    scaled_ = equilibrate(system);
  }
  if (!scaled_.mistake.empty()) {
    last_.forget();
    return last_report_ = LinearReport::failure(scaled_.mistake);
  }
  last_report_ = change == Change::pattern ? order() : LinearReport::success();
  if (last_report_.solved) last_report_ = factor_values();
  if (!last_report_.solved) last_.forget();  // MUMPS promises nothing about an instance after an error
  return last_report_;
}

LinearReport MumpsSolver::order() {
  const Stopwatch watch(counts_.seconds_ordering);
  const SparseMatrix& a = scaled_.matrix;
  mumps_->rows.resize(a.nonZeros());
  mumps_->columns.resize(a.nonZeros());
  for (int row = 0; row < a.rows(); ++row)
    for (int k = a.outerIndexPtr()[row]; k < a.outerIndexPtr()[row + 1]; ++k) {
      mumps_->rows[k] = system_.rows[row] + 1;
      mumps_->columns[k] = a.innerIndexPtr()[k] + 1;
    }
  mumps_->data.n = static_cast<int>(a.cols());
  mumps_->data.nnz_loc = a.nonZeros();
  mumps_->data.irn_loc = mumps_->rows.data();
  mumps_->data.jcn_loc = mumps_->columns.data();
  mumps_->data.a_loc = scaled_.matrix.valuePtr();
  mumps_->run(analyse);
  ++counts_.orderings;
  if (mumps_->status() == -6) return LinearReport::failure("the matrix is singular (its pattern alone shows it)");
  if (mumps_->status() < 0)
    return LinearReport::failure("the analysis of MUMPS failed with status " + std::to_string(mumps_->status()));
  return LinearReport::success();
}

LinearReport MumpsSolver::factor_values() {
  const Stopwatch watch(counts_.seconds_factor);
  mumps_->data.a_loc = scaled_.matrix.valuePtr();
  // What is a zero pivot: the default, round-off of the largest entry; where sums of balances hold by less, zero.
  mumps_->data.cntl[2] = system_.sums.empty() ? 0 : -1e-200;
  const int spare = mumps_->icntl(14);
  // Pivoting may need more room than the analysis foresaw (-9: the main array, -8, -17, -20: buffers).
  for (int attempt = 0; attempt < 6; ++attempt) {
    mumps_->run(factorize);
    const int status = mumps_->status();
    if (status != -9 && status != -8 && status != -17 && status != -20) break;
    mumps_->icntl(14) *= 2;
  }
  ++counts_.factorizations;
  const int status = mumps_->status();
  if (status < 0) mumps_->icntl(14) = spare;
  if (status < 0)
    return LinearReport::failure("the factorization of MUMPS failed with status " + std::to_string(status));
  if (mumps_->data.infog[27] > 0) {  // the number of zero pivots; their list is on the root
    int row = parallel::is_root() ? mumps_->data.pivnul_list[0] : 0;
    MPI_Bcast(&row, 1, MPI_INT, 0, MPI_COMM_WORLD);
    return LinearReport::failure("the matrix is singular (a zero pivot in the row of " +
                                 describe_unknown(system_.blocks, row - 1) + ")");
  }
  const std::string reason = find_singularity(
      system_, scaled_.matrix, [this](Vector& v) { apply_inverse(v, false); },
      [this](Vector& v) { apply_inverse(v, true); });
  return reason.empty() ? LinearReport::success() : LinearReport::failure(reason);
}

LinearReport MumpsSolver::solve(const Vector& b_rows, Vector& x) {
  if (!last_report_.solved) return last_report_;
  const Stopwatch watch(counts_.seconds_solve);
  ++counts_.solves;
  return refined_solve(
      system_, scaled_, b_rows, [this](Vector& v) { apply_inverse(v, false); }, x);
}

bool MumpsSolver::solve_columns(Eigen::Ref<Eigen::MatrixXd> columns) {
  if (parallel::size() > 1) return false;
  const Stopwatch watch(counts_.seconds_solve);
  counts_.columns += static_cast<int>(columns.cols());
  constexpr int together = 32;  // more than one is what makes it fast; all of them would double the memory
  Eigen::MatrixXd block(columns.rows(), std::min<Eigen::Index>(together, columns.cols()));
  mumps_->icntl(9) = 1;
  for (Eigen::Index first = 0; first < columns.cols(); first += block.cols()) {
    const Eigen::Index count = std::min(block.cols(), columns.cols() - first);
    block.leftCols(count) = scaled_.row_scale.asDiagonal() * columns.middleCols(first, count);
    mumps_->data.rhs = block.data();
    mumps_->data.nrhs = static_cast<int>(count);
    mumps_->data.lrhs = mumps_->data.n;
    mumps_->run(back_substitute);
    columns.middleCols(first, count) = scaled_.column_scale.asDiagonal() * block.leftCols(count);
  }
  return true;
}

void MumpsSolver::apply_inverse(Vector& v, bool transposed) {
  mumps_->icntl(9) = transposed ? 2 : 1;
  mumps_->data.rhs = v.data();
  mumps_->data.nrhs = 1;
  mumps_->data.lrhs = mumps_->data.n;
  mumps_->run(back_substitute);
  MPI_Bcast(v.data(), static_cast<int>(v.size()), MPI_DOUBLE, 0, MPI_COMM_WORLD);
}

}  // namespace sprekk
