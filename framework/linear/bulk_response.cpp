#include "framework/linear/bulk_response.hpp"

#include <algorithm>
#include <cmath>
#include <cstring>
#include <optional>

#include "framework/invariants.hpp"

namespace sprekk {

namespace {

/// The columns of A_BF for those unknowns, and the rows of A_FB.
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

/// The power of two, or its negative, with which all of a are the bits of b, if there is one.
std::optional<double> common_factor(const double* a, const double* b, int size) {
  const auto begins = std::find_if(a, a + size, [](double x) { return x != 0; });
  const double factor = begins == a + size ? 1 : b[begins - a] / *begins;
  int exponent = 0;
  if (std::abs(std::frexp(factor, &exponent)) != 0.5) return std::nullopt;
  const bool fits = std::equal(a, a + size, b, [factor](double x, double y) { return factor * x == y; });
  return fits ? std::optional(factor) : std::nullopt;
}

}  // namespace

LinearReport BulkResponse::compute(const BulkSplitting& split, LinearSolver& solver, bool is_short_lived) {
  is_whole_ = false;
  columns_.resize(0, 0);
  of_felt_rows_.clear();
  of_bordered_.clear();
  if (is_short_lived)
    if (const std::optional<LinearReport> report = compute_bordered(split, solver)) return *report;

  const LinearReport report = solver.factor(split.bulk_system());
  if (report.solved && !solve_columns(split, solver))
    return LinearReport::failure(solver.name() + " does not solve for columns");
  return report;
}

std::optional<LinearReport> BulkResponse::compute_bordered(const BulkSplitting& split, LinearSolver& solver) {
  Eigen::MatrixXd response;
  const std::optional<LinearReport> report =
      solver.factor_bordered(split.bulk_system(), chosen_columns(split.bf.matrix, split.felt),
                             chosen_rows(split.fb.matrix, split.feeling), response);
  of_bordered_.clear();
  if (report && report->solved) {
    SPREKK_ASSERT(response.rows() == static_cast<Eigen::Index>(split.feeling.size()), response.rows());
    SPREKK_ASSERT(response.cols() == static_cast<Eigen::Index>(split.felt.size()), response.cols());
    SPREKK_ASSERT(is_finite(response));
    bordered_ = response;
    of_bordered_.assign(split.fb.matrix.valuePtr(), split.fb.matrix.valuePtr() + split.fb.matrix.nonZeros());
  }
  return report;
}

bool BulkResponse::solve_columns(const BulkSplitting& split, LinearSolver& solver) {
  const int rows = split.bulk_size(), count = static_cast<int>(split.felt.size());
  SPREKK_EXPECT(are_indices(split.near, rows), rows);
  const SparseMatrix felt = chosen_columns(split.bf.matrix, split.felt);
  near_.resize(split.near.size(), count);
  is_whole_ = static_cast<double>(rows) * count <= largest_;
  columns_.resize(rows, 0);  // what it stays if nothing is felt
  const int width = is_whole_ ? count : piece_;
  for (int first = 0; first < count; first += width) {
    const int end = std::min(count, first + width);
    columns_.setZero(rows, end - first);
    for (int row = 0; row < rows; ++row)
      for (SparseMatrix::InnerIterator entry(felt, row); entry; ++entry)
        if (entry.col() >= first && entry.col() < end) columns_(row, entry.col() - first) = entry.value();
    if (!solver.solve_columns(columns_)) return false;
    for (std::size_t k = 0; k < split.near.size(); ++k)
      near_.row(k).segment(first, end - first) = columns_.row(split.near[k]);
  }
  if (!is_whole_) columns_.resize(0, 0);
  return true;
}

/// Row k of A_FB with X.
void BulkResponse::multiply(const BulkSplitting& split, std::size_t k) {
  SPREKK_EXPECT(k < split.feeling.size(), k, split.feeling.size());
  SPREKK_ASSERT(felt_rows_.cols() == near_.cols(), felt_rows_.cols(), near_.cols());
  const SparseMatrix& fb = split.fb.matrix;
  felt_rows_.row(k).setZero();
  for (SparseMatrix::InnerIterator entry(fb, split.feeling[k]); entry; ++entry)
    felt_rows_.row(k) += entry.value() * near_.row(split.near_place[entry.col()]);
}

bool BulkResponse::are_multiples_of_bordered(const BulkSplitting& split) const {
  const SparseMatrix& fb = split.fb.matrix;
  return std::all_of(split.feeling.begin(), split.feeling.end(), [&](int row) {
    const int begin = fb.outerIndexPtr()[row], count = fb.outerIndexPtr()[row + 1] - begin;
    return common_factor(&of_bordered_[begin], fb.valuePtr() + begin, count).has_value();
  });
}

const BulkResponse::RowMatrix* BulkResponse::felt_rows(const BulkSplitting& split, LinearSolver& solver) {
  const SparseMatrix& fb = split.fb.matrix;
  if (!of_bordered_.empty() && !are_multiples_of_bordered(split)) {
    of_felt_rows_.clear();
    const std::optional<LinearReport> report = compute_bordered(split, solver);
    if (!report || !report->solved) return nullptr;
  }
  const bool is_first = of_felt_rows_.empty();
  if (is_first) {
    of_felt_rows_.resize(fb.nonZeros());
    felt_rows_.resize(split.feeling.size(), split.felt.size());
  }
  for (std::size_t k = 0; k < split.feeling.size(); ++k) {
    const int begin = fb.outerIndexPtr()[split.feeling[k]], count = fb.outerIndexPtr()[split.feeling[k] + 1] - begin;
    const double* const values = fb.valuePtr() + begin;
    if (!is_first && std::memcmp(&of_felt_rows_[begin], values, count * sizeof(double)) == 0) continue;
    std::memcpy(&of_felt_rows_[begin], values, count * sizeof(double));
    if (of_bordered_.empty())
      multiply(split, k);
    else
      felt_rows_.row(k) = *common_factor(&of_bordered_[begin], values, count) * bordered_.row(k);
  }
  return &felt_rows_;
}

void BulkResponse::subtract(const BulkSplitting& split, LinearSolver& solver, const Vector& local, Vector& bulk) const {
  SPREKK_EXPECT(local.size() == split.local_size(), local.size(), split.local_size());
  SPREKK_EXPECT(bulk.size() == split.bulk_size(), bulk.size(), split.bulk_size());
  if (is_whole_) {
    Vector felt(split.felt.size());
    for (std::size_t c = 0; c < split.felt.size(); ++c) felt[c] = local[split.felt[c]];
    bulk.noalias() -= columns_ * felt;
    return;
  }
  Eigen::MatrixXd answer = split.bf.matrix * local;
  solver.solve_columns(answer);
  bulk -= answer;
}

}  // namespace sprekk
