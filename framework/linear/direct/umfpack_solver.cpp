#include "framework/linear/direct/umfpack_solver.hpp"

#include <umfpack.h>

#include <algorithm>
#include <cmath>

#include "framework/invariants.hpp"
#include "framework/linear/direct/near_singular.hpp"
#include "framework/linear/direct/umfpack_factors.hpp"
#include "framework/linear/entity_graph.hpp"
#include "framework/linear/expect_sound.hpp"
#include "framework/linear/refined_solve.hpp"
#include "framework/linear/stopwatch.hpp"
#include "framework/linear/unknown_names.hpp"
#include "framework/parallel/alone.hpp"
#include "framework/round_off.hpp"

namespace sprekk {
namespace {

static_assert(UMFPACK_CONTROL == 20, "the array of controls has the length that UMFPACK expects");

std::string status_text(int status) {
  switch (status) {
    case UMFPACK_ERROR_out_of_memory:
      return "UMFPACK ran out of memory (the factors are too large) use belos, or mumps on several processes";
    case UMFPACK_ERROR_ordering_failed:
      return "UMFPACK could not order the matrix";
    default:
      return "UMFPACK failed with status " + std::to_string(status);
  }
}

}  // namespace

UmfpackSolver::UmfpackSolver() {
  use_one_blas_thread();
  umfpack_di_defaults(control_.data());
#ifdef UMFPACK_ORDERING_METIS
  control_[UMFPACK_ORDERING] = UMFPACK_ORDERING_METIS;
#else
  control_[UMFPACK_ORDERING] = UMFPACK_ORDERING_AMD;
#endif
  control_[UMFPACK_SCALE] = UMFPACK_SCALE_NONE;
  control_[UMFPACK_IRSTEP] = 0;
}

UmfpackSolver::~UmfpackSolver() {
  if (numeric_ != nullptr) umfpack_di_free_numeric(&numeric_);
  if (symbolic_ != nullptr) umfpack_di_free_symbolic(&symbolic_);
}

LinearReport UmfpackSolver::factor(const LinearSystem& system) {
  expect_sound(system);
  if (!system.local.isCompressed()) {
    LinearSystem compressed = system;
    compressed.local.makeCompressed();
    return factor(compressed);
  }
  if (system.local.rows() != system.local.cols())
    return LinearReport::failure("umfpack needs all rows of the system on this process");
  const parallel::Alone with_all_rows;
  const Change change = last_.compare_and_remember(system);
  if (change == Change::nothing) {
    ++counts_.reused;
    return last_report_;
  }
  system_.rows = system.rows;
  system_.blocks = system.blocks;
  if (numeric_ != nullptr) umfpack_di_free_numeric(&numeric_);
  if (change == Change::pattern && symbolic_ != nullptr) umfpack_di_free_symbolic(&symbolic_);
  {
    const Stopwatch watch(counts_.seconds_factor);
    scaled_ = equilibrate(system);
  }
  last_report_ = scaled_.mistake.empty() ? LinearReport::success() : LinearReport::failure(scaled_.mistake);
  if (last_report_.solved && symbolic_ == nullptr) last_report_ = order();
  if (last_report_.solved) last_report_ = factor_values();
  return last_report_;
}

// The arrays of our rows are, read as columns, those of the transpose: UMFPACK factorizes A^T, and its transposed solve
// is the one with A. The values stay hidden from the analysis, so that a kept ordering is the one that a new analysis
// would find.
LinearReport UmfpackSolver::order() {
  const Stopwatch watch(counts_.seconds_ordering);
  const SparseMatrix& a = scaled_.matrix;
  const int n = static_cast<int>(a.rows());
  const std::vector<int> given = order_of_entities();
  SPREKK_ASSERT(given.empty() || static_cast<int>(given.size()) == n, given.size(), n);
  SPREKK_ASSERT(are_indices(given, n), n);
  int status = UMFPACK_OK;
  std::array<double, UMFPACK_CONTROL> control = control_;
  if (given.empty()) {
    // Where most entries are in a dense block, as in condensed systems, METIS takes ten times as long as the
    // factorization and gives no less fill than COLAMD. Treating rows as dense makes UMFPACK two to five times slower
    // there.
    constexpr int mostly_dense = 50, small = 1000;
    if (n < small || a.nonZeros() / mostly_dense > n) {
      control[UMFPACK_ORDERING] = UMFPACK_ORDERING_AMD;
      control[UMFPACK_DENSE_ROW] = n;
    }
    status =
        umfpack_di_symbolic(n, n, a.outerIndexPtr(), a.innerIndexPtr(), nullptr, &symbolic_, control.data(), nullptr);
  } else {
    // Without values UMFPACK cannot see that the diagonal is full, as it is for bulks, and would not prefer pivots
    // from it, which leave residuals that are ten times smaller.
    control[UMFPACK_STRATEGY] = UMFPACK_STRATEGY_SYMMETRIC;
    status = umfpack_di_qsymbolic(n, n, a.outerIndexPtr(), a.innerIndexPtr(), nullptr, given.data(), &symbolic_,
                                  control.data(), nullptr);
  }
  ++counts_.orderings;
  if (status != UMFPACK_OK) return LinearReport::failure(status_text(status));
  integer_work_.resize(n);
  work_.resize(n);
  return LinearReport::success();
}

std::vector<int> UmfpackSolver::order_of_entities() const {
  const bool has_local = std::any_of(system_.blocks.begin(), system_.blocks.end(), [](const UnknownBlock& block) {
    return block.kind == BlockKind::interface && block.entities > 0;
  });
  if (has_local) return {};  // zero diagonals need pivots that an ordering of entities cannot foresee
  const EntityGraph graph(scaled_.matrix, system_.blocks);
  const int n = graph.size();
  if (n == static_cast<int>(scaled_.matrix.rows())) return {};
  void* symbolic = nullptr;
  std::array<double, UMFPACK_CONTROL> control = control_;
  // Pivots will come from the diagonal. Without values UMFPACK does not see that, and would order columns alone: with
  // 1.4 times the fill, and 3 times where many entities depend on some that do not depend on them, as around tips of
  // fractures.
  control[UMFPACK_STRATEGY] = UMFPACK_STRATEGY_SYMMETRIC;
  constexpr int worth_dissecting = 4000;  // below, minimum degree is faster and gives no more fill
  if (n < worth_dissecting) control[UMFPACK_ORDERING] = UMFPACK_ORDERING_AMD;
  if (umfpack_di_symbolic(n, n, graph.starts().data(), graph.neighbours().data(), nullptr, &symbolic, control.data(),
                          nullptr) != UMFPACK_OK)
    return {};
  std::vector<int> order(n);
  umfpack_di_get_symbolic(nullptr, nullptr, nullptr, nullptr, nullptr, nullptr, nullptr, order.data(), nullptr, nullptr,
                          nullptr, nullptr, nullptr, nullptr, nullptr, symbolic);
  umfpack_di_free_symbolic(&symbolic);
  return graph.unknowns_in_order(order);
}

LinearReport UmfpackSolver::factor_values() {
  const Stopwatch watch(counts_.seconds_factor);
  const SparseMatrix& a = scaled_.matrix;
  std::array<double, UMFPACK_INFO> info;
  const int status = umfpack_di_numeric(a.outerIndexPtr(), a.innerIndexPtr(), a.valuePtr(), symbolic_, &numeric_,
                                        control_.data(), info.data());
  ++counts_.factorizations;
  if (status == UMFPACK_WARNING_singular_matrix) return LinearReport::failure(describe_zero_pivot());
  if (status != UMFPACK_OK) return LinearReport::failure(status_text(status));
  factor_entries_ = static_cast<long>(info[UMFPACK_LNZ] + info[UMFPACK_UNZ]);

  // The ratio of the pivots costs nothing and is small for every matrix that is singular to working precision; it may
  // be small for good ones too, so those are looked at more closely.
  if (info[UMFPACK_RCOND] < rounding::half_of_digits) {
    const std::string reason = find_singularity(system_, a, [this](Vector& v) { apply_inverse(v); });
    if (!reason.empty()) return LinearReport::failure(reason);
  }
  return LinearReport::success();
}

LinearReport UmfpackSolver::solve(const Vector& b_rows, Vector& x) {
  if (!last_report_.solved) return last_report_;
  const parallel::Alone with_all_rows;
  const Stopwatch watch(counts_.seconds_solve);
  ++counts_.solves;
  return refined_solve(
      system_, scaled_, b_rows, [this](Vector& v) { apply_inverse(v); }, x);
}

void UmfpackSolver::solve_unchecked(Eigen::Ref<Vector> b) const {
  SPREKK_EXPECT(numeric_ != nullptr);
  SPREKK_EXPECT(b.size() == scaled_.row_scale.size(), b.size(), scaled_.row_scale.size());
  Vector y = scaled_.row_scale.cwiseProduct(b);
  apply_inverse(y);
  b = scaled_.column_scale.cwiseProduct(y);
}

bool UmfpackSolver::solve_columns(Eigen::Ref<Eigen::MatrixXd> columns) {
  SPREKK_EXPECT(numeric_ != nullptr);
  SPREKK_EXPECT(columns.rows() == scaled_.matrix.rows(), columns.rows(), scaled_.matrix.rows());
  const Stopwatch watch(counts_.seconds_solve);
  counts_.columns += static_cast<int>(columns.cols());
  columns = scaled_.row_scale.asDiagonal() * columns;
  UmfpackFactors(numeric_, static_cast<int>(scaled_.matrix.rows())).solve(columns);
  columns = scaled_.column_scale.asDiagonal() * columns;
  return true;
}

void UmfpackSolver::apply_inverse(Vector& v) const {
  SPREKK_ASSERT(numeric_ != nullptr && v.size() == scaled_.matrix.rows(), v.size(), scaled_.matrix.rows());
  const SparseMatrix& a = scaled_.matrix;
  right_hand_side_ = v;
  umfpack_di_wsolve(UMFPACK_At, a.outerIndexPtr(), a.innerIndexPtr(), a.valuePtr(), v.data(), right_hand_side_.data(),
                    numeric_, control_.data(), nullptr, integer_work_.data(), work_.data());
}

// P A^T Q = L U: pivot k stands for the unknown P[k] (a row of A^T) and the balance Q[k] (a column).
std::string UmfpackSolver::describe_zero_pivot() const {
  const int n = static_cast<int>(scaled_.matrix.rows());
  std::vector<int> p(n), q(n);
  Vector diagonal(n);
  int is_reciprocal = 0;
  umfpack_di_get_numeric(nullptr, nullptr, nullptr, nullptr, nullptr, nullptr, p.data(), q.data(), diagonal.data(),
                         &is_reciprocal, nullptr, numeric_);
  int smallest = 0;
  diagonal.cwiseAbs().minCoeff(&smallest);
  return "the matrix is singular (a zero pivot for " + describe_unknown(system_.blocks, p[smallest]) +
         " in the balance of " + describe_unknown(system_.blocks, q[smallest]) + ")";
}

}  // namespace sprekk
