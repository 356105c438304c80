#include "framework/linear/direct/dense_core_solver.hpp"

#include <algorithm>
#include <cmath>
#include <numeric>
#include <queue>

#include "framework/invariants.hpp"
#include "framework/linear/direct/near_singular.hpp"
#include "framework/linear/refined_solve.hpp"
#include "framework/linear/stopwatch.hpp"
#include "framework/linear/unknown_names.hpp"
#include "framework/parallel/alone.hpp"
#include "framework/round_off.hpp"

extern "C" {
void dgetrf_(const int* rows, const int* columns, double* a, const int* stride, int* exchanged, int* info);
void dgetrs_(const char* transposed, const int* n, const int* right_hand_sides, const double* lu, const int* stride,
             const int* exchanged, double* b, const int* stride_of_b, int* info);
}

namespace sprekk {
namespace {

constexpr int longest = 128;  // entries of a short row: longer ones take as long as rows of the core
constexpr int few = 200;      // long rows: with fewer UMFPACK takes a few milliseconds, and as long or less
// Of the entries of a row, which are near one: a row of which less is left has lost digits, and multiples of it would
// be large. The core chooses its pivots from all of its rows.
constexpr double cancelled = 1e-2;
constexpr double threshold = 0.1;  // of the largest entry of its row that a pivot has at least, as UMFPACK's default

int long_rows(const SparseMatrix& a) {
  int count = 0;
  for (int row = 0; row < a.rows(); ++row) count += a.outerIndexPtr()[row + 1] - a.outerIndexPtr()[row] > longest;
  return count;
}

}  // namespace

LinearReport DenseCoreSolver::factor(const LinearSystem& system) {
  const parallel::Alone with_all_rows;
  use_one_blas_thread();
  system_.rows = system.rows;
  system_.blocks = system.blocks;
  is_sparse_ = !system.local.isCompressed() || long_rows(system.local) < few;
  if (!is_sparse_) {
    const Stopwatch watch(counts_.seconds_factor);
    scaled_ = equilibrate(system);
    if (!scaled_.mistake.empty()) return last_report_ = LinearReport::failure(scaled_.mistake);
    eliminate_short_rows();
    if (gather_core()) {
      last_report_ = factor_core();
      return last_report_;
    }
  }
  is_sparse_ = true;
  last_report_ = umfpack_.factor(system);
  return last_report_;
}

/// Takes multiples of the pivots' rows from a row, until it has no entries in their columns.
DenseCoreSolver::Row DenseCoreSolver::reduced(int row) {
  Row result;
  result.row = row;
  std::priority_queue<int, std::vector<int>, std::greater<>> pivots;  // that the row has columns of
  std::vector<int> columns;
  const auto subtract = [&](int column, double value) {
    if (is_touched_[column] == 0) {
      is_touched_[column] = 1;
      work_[column] = 0;
      if (pivot_of_[column] < 0)
        columns.push_back(column);
      else
        pivots.push(pivot_of_[column]);
    }
    work_[column] -= value;
  };
  for (SparseMatrix::InnerIterator entry(scaled_.matrix, row); entry; ++entry)
    if (entry.value() != 0) subtract(static_cast<int>(entry.col()), -entry.value());
  while (!pivots.empty()) {
    const int k = pivots.top();
    pivots.pop();
    const Row& pivot = pivots_[k];
    const double factor = work_[pivot.column] / pivot.pivot;
    is_touched_[pivot.column] = 0;
    if (factor == 0) continue;
    result.lower.emplace_back(k, factor);
    for (const auto& [column, value] : pivot.upper) subtract(column, factor * value);
  }
  for (const int column : columns) {
    is_touched_[column] = 0;
    if (work_[column] != 0) result.upper.emplace_back(column, work_[column]);
  }
  return result;
}

/// Of the entries that are not small beside the others, the one whose column has the fewest. False for none.
bool DenseCoreSolver::choose_pivot(Row& row) const {
  double largest = 0;
  for (const auto& [column, value] : row.upper) largest = std::max(largest, std::abs(value));
  if (row.upper.size() > longest || largest < cancelled) return false;
  const auto best = std::ranges::min_element(row.upper, {}, [&](const std::pair<int, double>& entry) {
    const bool is_small = std::abs(entry.second) < threshold * largest;
    return std::pair(is_small ? scaled_.matrix.rows() + 1 : entries_[entry.first], entry.first);
  });
  std::tie(row.column, row.pivot) = *best;
  row.upper.erase(best);
  return true;
}

void DenseCoreSolver::eliminate_short_rows() {
  const SparseMatrix& a = scaled_.matrix;
  const auto n = static_cast<std::size_t>(a.rows());
  entries_.assign(n, 0);
  pivot_of_.assign(n, -1);
  work_.resize(n);
  is_touched_.assign(n, 0);
  pivots_.clear();
  std::vector<std::vector<int>> rows_of_length(longest + 1);
  for (int row = 0; row < a.rows(); ++row) {
    std::size_t length = 0;
    for (SparseMatrix::InnerIterator entry(a, row); entry; ++entry) {
      if (entry.value() == 0) continue;
      ++entries_[entry.col()];
      ++length;
    }
    if (length <= longest) rows_of_length[length].push_back(row);
  }
  for (const std::vector<int>& rows : rows_of_length)
    for (const int row : rows) {
      Row candidate = reduced(row);
      if (!choose_pivot(candidate)) continue;
      pivot_of_[candidate.column] = static_cast<int>(pivots_.size());
      pivots_.push_back(std::move(candidate));
    }
}

/// Makes the core of the rows without a pivot. False where it is large although few rows are long.
bool DenseCoreSolver::gather_core() {
  const SparseMatrix& a = scaled_.matrix;
  std::vector<char> has_pivot(a.rows(), 0);
  for (const Row& pivot : pivots_) has_pivot[pivot.row] = 1;
  const auto size = static_cast<std::size_t>(a.rows()) - pivots_.size();
  if (size > 2 * static_cast<std::size_t>(long_rows(a))) return false;  // half of it is there for another reason
  std::vector<Row> rows;
  for (int row = 0; row < a.rows(); ++row)
    if (has_pivot[row] == 0) rows.push_back(reduced(row));
  take_single_columns(rows);
  return true;
}

/// Takes rows with the only entry of a column out of the core, and makes it of those that are left.
void DenseCoreSolver::take_single_columns(std::vector<Row>& rows) {
  const std::size_t n = pivot_of_.size();
  std::vector<int> count(n, 0), row_with(n, 0);  // the sum of the rows with an entry is the row, where there is one
  const auto add = [&](int number, int sign) {
    for (const auto& [column, value] : rows[number].upper) {
      count[column] += sign;
      row_with[column] += sign * number;
    }
  };
  for (int number = 0; number < static_cast<int>(rows.size()); ++number) add(number, 1);
  std::vector<int> single;
  std::vector<char> is_taken(n, 0);
  for (int column = 0; column < static_cast<int>(n); ++column)
    if (pivot_of_[column] < 0 && count[column] == 1) single.push_back(column);
  last_.clear();
  for (std::size_t k = 0; k < single.size(); ++k) {
    const int column = single[k];
    if (count[column] != 1) continue;
    Row& row = rows[row_with[column]];
    double largest = 0;
    for (const auto& [other, value] : row.upper) largest = std::max(largest, std::abs(value));
    const auto entry = std::ranges::find(row.upper, column, &std::pair<int, double>::first);
    if (std::abs(entry->second) < threshold * largest) continue;
    add(row_with[column], -1);
    for (const auto& [other, value] : row.upper)
      if (count[other] == 1) single.push_back(other);
    row.column = column;
    row.pivot = entry->second;
    row.upper.erase(entry);
    is_taken[column] = 1;
    last_.push_back(std::move(row));
    row.row = -1;
  }
  std::erase_if(rows, [](const Row& row) { return row.row < 0; });
  rows_of_core_ = std::move(rows);
  columns_of_core_.clear();
  std::vector<int> place(n, -1);
  for (int column = 0; column < static_cast<int>(n); ++column) {
    if (pivot_of_[column] >= 0 || is_taken[column] != 0) continue;
    place[column] = static_cast<int>(columns_of_core_.size());
    columns_of_core_.push_back(column);
  }
  SPREKK_ASSERT(rows_of_core_.size() == columns_of_core_.size(), rows_of_core_.size(), columns_of_core_.size());
  const auto size = static_cast<Eigen::Index>(columns_of_core_.size());
  core_.setZero(size, size);
  for (Eigen::Index i = 0; i < size; ++i) {
    for (const auto& [column, value] : rows_of_core_[i].upper) core_(i, place[column]) = value;
    rows_of_core_[i].upper.clear();
  }
}

LinearReport DenseCoreSolver::factor_core() {
  ++counts_.factorizations;
  const int size = core_size();
  exchanged_.resize(size);
  int info = 0;
  if (size > 0) dgetrf_(&size, &size, core_.data(), &size, exchanged_.data(), &info);
  SPREKK_ASSERT(info >= 0, info);
  if (info > 0)
    return LinearReport::failure("the matrix is singular (a zero pivot for " +
                                 describe_unknown(system_.blocks, columns_of_core_[info - 1]) + ")");
  double smallest = HUGE_VAL, largest = 0;
  const auto look_at = [&](double pivot) {
    smallest = std::min(smallest, std::abs(pivot));
    largest = std::max(largest, std::abs(pivot));
  };
  for (const Row& row : pivots_) look_at(row.pivot);
  for (const Row& row : last_) look_at(row.pivot);
  for (int k = 0; k < size; ++k) look_at(core_(k, k));
  // Pivots cost nothing to look at; those of a good matrix may be small, too, so it is looked at more closely.
  if (smallest < rounding::half_of_digits * largest) {
    const std::string reason = find_singularity(system_, scaled_.matrix, [this](Vector& v) { apply_inverse(v); });
    if (!reason.empty()) return LinearReport::failure(reason);
  }
  return LinearReport::success();
}

void DenseCoreSolver::apply_inverse(Vector& v) const {
  SPREKK_ASSERT(v.size() == static_cast<Eigen::Index>(pivot_of_.size()), v.size(), pivot_of_.size());
  Vector y(pivots_.size());
  const auto right_side = [&](const Row& row) {
    double sum = v[row.row];
    for (const auto& [pivot, factor] : row.lower) sum -= factor * y[pivot];
    return sum;
  };
  for (std::size_t k = 0; k < pivots_.size(); ++k) y[k] = right_side(pivots_[k]);
  Vector of_core(rows_of_core_.size()), of_last(last_.size());
  for (std::size_t k = 0; k < rows_of_core_.size(); ++k) of_core[k] = right_side(rows_of_core_[k]);
  for (std::size_t k = 0; k < last_.size(); ++k) of_last[k] = right_side(last_[k]);
  const int size = core_size(), one = 1;
  int info = 0;
  if (size > 0) dgetrs_("N", &size, &one, core_.data(), &size, exchanged_.data(), of_core.data(), &size, &info);
  SPREKK_ASSERT(info == 0, info);
  v(columns_of_core_) = of_core;
  const auto solve_for = [&](const Row& row, double sum) {
    for (const auto& [column, value] : row.upper) sum -= value * v[column];
    v[row.column] = sum / row.pivot;
  };
  for (std::size_t k = last_.size(); k-- > 0;) solve_for(last_[k], of_last[k]);
  for (std::size_t k = pivots_.size(); k-- > 0;) solve_for(pivots_[k], y[k]);
}

LinearReport DenseCoreSolver::solve(const Vector& b_rows, Vector& x) {
  if (!last_report_.solved) return last_report_;
  if (is_sparse_) return umfpack_.solve(b_rows, x);
  const parallel::Alone with_all_rows;
  const Stopwatch watch(counts_.seconds_solve);
  ++counts_.solves;
  const LinearReport report = refined_solve(
      system_, scaled_, b_rows, [this](Vector& v) { apply_inverse(v); }, x);
  return report.solved ? report : solve_with_free_pivots(b_rows, x);
}

/// Solves the system by UMFPACK, which chooses its pivots by columns and rows.
LinearReport DenseCoreSolver::solve_with_free_pivots(const Vector& b_rows, Vector& x) {
  system_.local = scaled_.matrix;
  LinearReport report = umfpack_.factor(system_);
  system_.local = SparseMatrix();
  if (!report.solved) return report;
  report = umfpack_.solve(scaled_.row_scale.cwiseProduct(b_rows), x);
  x = scaled_.column_scale.cwiseProduct(x);
  return report;
}

const LinearCounts& DenseCoreSolver::counts() const {
  total_ = counts_;
  return total_ += umfpack_.counts();
}

}  // namespace sprekk
