#include "framework/linear/reduction/bulk_schur_complement.hpp"

#include <algorithm>
#include <cmath>
#include <cstring>
#include <optional>

#include "framework/invariants.hpp"
#include "framework/parallel/parallel.hpp"

namespace sprekk {

namespace {

/// The given columns of a matrix that has no entries in others.
SparseMatrix chosen_columns(const SparseMatrix& a, const std::vector<int>& columns) {
  SPREKK_EXPECT(are_indices(columns, a.cols()), a.cols());
  SPREKK_EXPECT(is_ascending(columns));
  std::vector<int> place(a.cols(), -1);
  for (std::size_t c = 0; c < columns.size(); ++c) place[columns[c]] = static_cast<int>(c);
  SPREKK_EXPECT(std::all_of(a.innerIndexPtr(), a.innerIndexPtr() + a.nonZeros(), [&](int c) { return place[c] >= 0; }));
  SparseMatrix chosen(a.rows(), columns.size());
  chosen.reserve(a.nonZeros());
  for (int row = 0; row < a.rows(); ++row) {
    chosen.startVec(row);
    for (SparseMatrix::InnerIterator entry(a, row); entry; ++entry)
      chosen.insertBack(row, place[entry.col()]) = entry.value();
  }
  chosen.finalize();
  return chosen;
}

SparseMatrix chosen_rows(const SparseMatrix& a, const std::vector<int>& rows) {
  SPREKK_EXPECT(are_indices(rows, a.rows()), a.rows());
  SparseMatrix chosen(rows.size(), a.cols());
  chosen.reserve(a.nonZeros());
  for (std::size_t k = 0; k < rows.size(); ++k) {
    chosen.startVec(k);
    for (SparseMatrix::InnerIterator entry(a, rows[k]); entry; ++entry)
      chosen.insertBack(k, entry.col()) = entry.value();
  }
  chosen.finalize();
  return chosen;
}

/// The power of two, or its negative, that turns all values of `a` into those of `b` to the bit, if there is one.
std::optional<double> common_factor(const double* a, const double* b, int size) {
  const auto begins = std::find_if(a, a + size, [](double x) { return x != 0; });
  const double factor = begins == a + size ? 1 : b[begins - a] / *begins;
  int exponent = 0;
  if (std::abs(std::frexp(factor, &exponent)) != 0.5) return std::nullopt;
  const bool fits = std::equal(a, a + size, b, [factor](double x, double y) { return factor * x == y; });
  return fits ? std::optional(factor) : std::nullopt;
}

}  // namespace

LinearReport BulkSchurComplement::compute(const BulkSplitting& split, LinearSolver& solver, bool is_short_lived) {
  is_whole_ = false;
  columns_.resize(0, 0);
  schur_rows_made_with_.clear();
  of_bordered_.clear();
  if (is_short_lived)
    if (const std::optional<LinearReport> report = compute_bordered(split, solver)) return *report;

  const LinearReport report = solver.factor(split.bulk_system());
  if (report.solved && !solve_columns(split, solver))
    return LinearReport::failure(solver.name() + " does not solve for columns");
  return report;
}

std::optional<LinearReport> BulkSchurComplement::compute_bordered(const BulkSplitting& split, LinearSolver& solver) {
  Eigen::MatrixXd schur;
  const std::optional<LinearReport> report =
      solver.factor_bordered(split.bulk_system(), chosen_columns(split.bf.matrix, split.interface_columns),
                             chosen_rows(split.fb.matrix, split.interface_rows), schur);
  of_bordered_.clear();
  if (report && report->solved) {
    SPREKK_ASSERT(schur.rows() == static_cast<Eigen::Index>(split.interface_rows.size()), schur.rows());
    SPREKK_ASSERT(schur.cols() == static_cast<Eigen::Index>(split.interface_columns.size()), schur.cols());
    SPREKK_ASSERT(is_finite(schur));
    bordered_ = schur;
    of_bordered_.assign(split.fb.matrix.valuePtr(), split.fb.matrix.valuePtr() + split.fb.matrix.nonZeros());
  }
  return report;
}

bool BulkSchurComplement::solve_columns(const BulkSplitting& split, LinearSolver& solver) {
  const auto rows = static_cast<int>(split.bulk_rows.size()), count = static_cast<int>(split.interface_columns.size());
  SPREKK_EXPECT(are_indices(split.near, split.bulk_size()), split.bulk_size());
  const SparseMatrix from_interface = chosen_columns(split.bf.matrix, split.interface_columns);
  near_.setZero(split.near.size(), count);
  is_whole_ = static_cast<double>(split.bulk_size()) * count <= largest_;
  columns_.resize(rows, 0);  // stays empty without interface columns
  const int width = is_whole_ ? count : piece_;
  for (int first = 0; first < count; first += width) {
    const int end = std::min(count, first + width);
    columns_.setZero(rows, end - first);
    for (int row = 0; row < rows; ++row)
      for (SparseMatrix::InnerIterator entry(from_interface, row); entry; ++entry)
        if (entry.col() >= first && entry.col() < end) columns_(row, entry.col() - first) = entry.value();
    if (!solver.solve_columns(columns_)) return false;
    for (int row = 0; row < rows; ++row)
      if (const int k = split.near_place[split.bulk_rows[row]]; k >= 0)
        near_.row(k).segment(first, end - first) = columns_.row(row);
  }
  if (parallel::size() > 1) {
    Vector of_all = near_.reshaped<Eigen::RowMajor>();
    parallel::sum(of_all);
    near_.reshaped<Eigen::RowMajor>() = of_all;
  }
  if (!is_whole_) columns_.resize(0, 0);
  return true;
}

/// The product of row k of A_FB with X.
void BulkSchurComplement::multiply(const BulkSplitting& split, std::size_t k) {
  SPREKK_EXPECT(k < split.interface_rows.size(), k, split.interface_rows.size());
  SPREKK_ASSERT(schur_rows_.cols() == near_.cols(), schur_rows_.cols(), near_.cols());
  const SparseMatrix& fb = split.fb.matrix;
  schur_rows_.row(k).setZero();
  for (SparseMatrix::InnerIterator entry(fb, split.interface_rows[k]); entry; ++entry)
    schur_rows_.row(k) += entry.value() * near_.row(split.near_place[entry.col()]);
}

bool BulkSchurComplement::are_multiples_of_bordered(const BulkSplitting& split) const {
  const SparseMatrix& fb = split.fb.matrix;
  return std::all_of(split.interface_rows.begin(), split.interface_rows.end(), [&](int row) {
    const int begin = fb.outerIndexPtr()[row], count = fb.outerIndexPtr()[row + 1] - begin;
    return common_factor(&of_bordered_[begin], fb.valuePtr() + begin, count).has_value();
  });
}

const BulkSchurComplement::RowMatrix* BulkSchurComplement::schur_rows(const BulkSplitting& split,
                                                                      LinearSolver& solver) {
  const SparseMatrix& fb = split.fb.matrix;
  if (!of_bordered_.empty() && !are_multiples_of_bordered(split)) {
    schur_rows_made_with_.clear();
    const std::optional<LinearReport> report = compute_bordered(split, solver);
    if (!report || !report->solved) return nullptr;
  }
  const bool is_first = schur_rows_made_with_.empty();
  if (is_first) {
    schur_rows_made_with_.resize(fb.nonZeros());
    schur_rows_.resize(split.interface_rows.size(), split.interface_columns.size());
  }
  for (std::size_t k = 0; k < split.interface_rows.size(); ++k) {
    const int begin = fb.outerIndexPtr()[split.interface_rows[k]],
              count = fb.outerIndexPtr()[split.interface_rows[k] + 1] - begin;
    const double* const values = fb.valuePtr() + begin;
    if (!is_first && std::memcmp(&schur_rows_made_with_[begin], values, count * sizeof(double)) == 0) continue;
    std::memcpy(&schur_rows_made_with_[begin], values, count * sizeof(double));
    if (of_bordered_.empty())
      multiply(split, k);
    else
      schur_rows_.row(k) = *common_factor(&of_bordered_[begin], values, count) * bordered_.row(k);
  }
  return &schur_rows_;
}

void BulkSchurComplement::subtract(const BulkSplitting& split, LinearSolver& solver, const Vector& local,
                                   Vector& bulk) const {
  SPREKK_EXPECT(local.size() == split.local_size(), local.size(), split.local_size());
  SPREKK_EXPECT(bulk.size() == split.bulk_size(), bulk.size(), split.bulk_size());
  Vector mine = bulk(split.bulk_rows);
  if (is_whole_) {
    Vector of_interface(split.interface_columns.size());
    for (std::size_t c = 0; c < split.interface_columns.size(); ++c)
      of_interface[c] = local[split.interface_columns[c]];
    mine.noalias() -= columns_ * of_interface;
  } else {
    Eigen::MatrixXd answer = split.bf.matrix * local;
    solver.solve_columns(answer);
    mine -= answer;
  }
  bulk = split.whole_bulk(mine);
}

}  // namespace sprekk
