#include "framework/linear/bulk_response.hpp"

#include <algorithm>
#include <cstring>

namespace sprekk {

bool BulkResponse::compute(const BulkSplitting& split, LinearSolver& solver) {
  const int rows = split.bulk_size(), count = static_cast<int>(split.felt.size());
  std::vector<int> column_of(split.local_size(), -1);
  for (int c = 0; c < count; ++c) column_of[split.felt[c]] = c;

  of_felt_rows_.clear();
  near_.resize(split.near.size(), count);
  is_whole_ = static_cast<double>(rows) * count <= largest_;
  columns_.resize(rows, 0);  // what it stays if nothing is felt
  const int width = is_whole_ ? count : piece_;
  for (int first = 0; first < count; first += width) {
    const int end = std::min(count, first + width);
    columns_.setZero(rows, end - first);
    for (int row = 0; row < rows; ++row)
      for (SparseMatrix::InnerIterator entry(split.bf.matrix, row); entry; ++entry) {
        const int column = column_of[entry.col()];
        if (column >= first && column < end) columns_(row, column - first) = entry.value();
      }
    if (!solver.solve_columns(columns_)) return false;
    for (std::size_t k = 0; k < split.near.size(); ++k)
      near_.row(k).segment(first, end - first) = columns_.row(split.near[k]);
  }
  if (!is_whole_) columns_.resize(0, 0);
  return true;
}

const BulkResponse::RowMatrix& BulkResponse::felt_rows(const BulkSplitting& split) {
  const SparseMatrix& fb = split.fb.matrix;
  const bool is_first = of_felt_rows_.empty();
  if (is_first) {
    of_felt_rows_.resize(fb.nonZeros());
    felt_rows_.resize(split.feeling.size(), near_.cols());
  }
  for (std::size_t k = 0; k < split.feeling.size(); ++k) {
    const int begin = fb.outerIndexPtr()[split.feeling[k]], end = fb.outerIndexPtr()[split.feeling[k] + 1];
    const std::size_t size = (end - begin) * sizeof(double);
    if (!is_first && std::memcmp(&of_felt_rows_[begin], fb.valuePtr() + begin, size) == 0) continue;
    std::memcpy(&of_felt_rows_[begin], fb.valuePtr() + begin, size);
    felt_rows_.row(k).setZero();
    for (int e = begin; e < end; ++e)
      felt_rows_.row(k) += fb.valuePtr()[e] * near_.row(split.near_place[fb.innerIndexPtr()[e]]);
  }
  return felt_rows_;
}

void BulkResponse::subtract(const BulkSplitting& split, LinearSolver& solver, const Vector& local, Vector& bulk) const {
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
