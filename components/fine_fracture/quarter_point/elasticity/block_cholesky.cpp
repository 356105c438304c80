#include "components/fine_fracture/quarter_point/elasticity/block_cholesky.hpp"

#include <algorithm>
#include <stdexcept>

#include "framework/invariants.hpp"
#include "framework/mesh/mesh.hpp"

namespace sprekk::fine_fracture {

int BlockMatrix::find(int row, int column) const {
  SPREKK_EXPECT(is_index(column, count()) && row <= column, row, column, count());
  const auto place = std::lower_bound(rows.begin() + starts[column], rows.begin() + starts[column + 1], row);
  SPREKK_ASSERT(place != rows.begin() + starts[column + 1] && *place == row, row, column);
  return static_cast<int>(place - rows.begin());
}

BlockCholesky::BlockCholesky(const BlockMatrix& matrix) {
  SPREKK_EXPECT(matrix.rows.size() == matrix.blocks.size(), matrix.rows.size(), matrix.blocks.size());
  SPREKK_EXPECT(matrix.starts.back() == static_cast<int>(matrix.rows.size()), matrix.starts.back(), matrix.rows.size());
  SPREKK_EXPECT(are_indices(matrix.rows, matrix.count()), matrix.count());
  find_tree(matrix);
  factorize(matrix);
}

/// The elimination tree and the number of blocks in each column of L.
void BlockCholesky::find_tree(const BlockMatrix& matrix) {
  const int n = matrix.count();
  parent_.assign(n, none);
  starts_.assign(n + 1, 0);
  std::vector<int> seen_by(n, none);
  for (int k = 0; k < n; ++k) {
    seen_by[k] = k;
    for (int p = matrix.starts[k]; p < matrix.starts[k + 1]; ++p) {
      for (int i = matrix.rows[p]; seen_by[i] != k; i = parent_[i]) {
        if (parent_[i] == none) parent_[i] = k;
        ++starts_[i + 1];
        seen_by[i] = k;
      }
    }
  }
  for (int k = 0; k < n; ++k) starts_[k + 1] += starts_[k];
}

void BlockCholesky::factorize(const BlockMatrix& matrix) {
  const int n = matrix.count();
  rows_.resize(starts_[n]);
  lower_.resize(starts_[n]);
  inverse_.resize(n);
  std::vector<int> ends(starts_.begin(), starts_.end() - 1);  // ends of the known parts of the columns
  std::vector<int> seen_by(n, none), reached(n), way(n);
  std::vector<Block> row(n, Block::Zero());
  for (int k = 0; k < n; ++k) {
    // The pattern of row k of L: all columns on the paths from the entries of the row up the tree.
    int top = n;
    seen_by[k] = k;
    for (int p = matrix.starts[k]; p < matrix.starts[k + 1]; ++p) {
      int length = 0;
      row[matrix.rows[p]] = matrix.blocks[p];
      for (int i = matrix.rows[p]; seen_by[i] != k; i = parent_[i]) {
        way[length++] = i;
        seen_by[i] = k;
      }
      while (length > 0) reached[--top] = way[--length];
    }
    const Block diagonal = row[k];
    SPREKK_EXPECT(std::abs(diagonal(0, 1) - diagonal(1, 0)) <= nearly_equal * diagonal.norm(), k, diagonal(0, 1),
                  diagonal(1, 0));
    SPREKK_EXPECT(diagonal.allFinite(), k);
    Block pivot = diagonal;
    row[k].setZero();
    for (; top < n; ++top) {
      const int i = reached[top];
      const Block y = row[i];
      row[i].setZero();
      const int end = ends[i];
      for (int p = starts_[i]; p < end; ++p) row[rows_[p]].noalias() -= lower_[p] * y;
      const Block transposed = inverse_[i] * y;
      pivot.noalias() -= y.transpose() * transposed;
      rows_[end] = k;
      lower_[end] = transposed.transpose();
      ++ends[i];
      SPREKK_ASSERT(ends[i] <= starts_[i + 1], i, ends[i], starts_[i + 1]);
    }
    invert(k, pivot, diagonal);
  }
}

void BlockCholesky::invert(int column, const Block& pivot, const Block& diagonal) {
  // Of the diagonal, some ten roundings: a smaller pivot is that of a singular stiffness.
  constexpr double rounding = 1e-14;
  const double a = pivot(0, 0), b = 0.5 * (pivot(0, 1) + pivot(1, 0)), c = pivot(1, 1);
  const double rest = c - b * b / a;
  if (!(a > rounding * diagonal(0, 0)) || !(rest > rounding * diagonal(1, 1)))
    throw std::runtime_error("the matrix is not positive definite");
  inverse_[column] << c, -b, -b, a;
  inverse_[column] /= a * rest;
}

BlockCholesky::Columns BlockCholesky::solve_within(const std::vector<int>& blocks, const Columns& b) const {
  const int n = static_cast<int>(inverse_.size());
  SPREKK_EXPECT(are_indices(blocks, n), n);
  SPREKK_EXPECT(b.rows() == 2 * static_cast<Eigen::Index>(blocks.size()), b.rows(), blocks.size());
  SPREKK_EXPECT(is_finite(b.reshaped()), b.rows());
  // The blocks on the way up the tree, ascending, and the place of each in x.
  std::vector<int> reached, place(n, none);
  for (const int block : blocks)
    for (int i = block; i != none && place[i] == none; i = parent_[i]) {
      place[i] = 0;
      reached.push_back(i);
    }
  std::ranges::sort(reached);
  for (std::size_t k = 0; k < reached.size(); ++k) place[reached[k]] = static_cast<int>(k);
  const Eigen::Index width = b.cols();
  Columns x = Columns::Zero(2 * static_cast<Eigen::Index>(reached.size()), width);
  for (std::size_t k = 0; k < blocks.size(); ++k) x.middleRows<2>(2 * place[blocks[k]]) += b.middleRows<2>(2 * k);
  // y -= block x, for two rows of all columns.
  const auto subtract = [width](const Block& block, const double* x, double* y) {
    const double a = block(0, 0), c = block(0, 1), d = block(1, 0), e = block(1, 1);
    for (Eigen::Index k = 0; k < width; ++k) {
      y[k] -= a * x[k] + c * x[width + k];
      y[width + k] -= d * x[k] + e * x[width + k];
    }
  };
  const auto rows = [&](int block) { return x.data() + 2 * place[block] * width; };
  for (const int i : reached)
    for (int p = starts_[i]; p < starts_[i + 1]; ++p) subtract(lower_[p], rows(i), rows(rows_[p]));
  for (auto k = reached.rbegin(); k != reached.rend(); ++k) {
    const int i = *k;
    x.middleRows<2>(2 * place[i]) = (inverse_[i] * x.middleRows<2>(2 * place[i])).eval();
    for (int p = starts_[i]; p < starts_[i + 1]; ++p) subtract(lower_[p].transpose(), rows(rows_[p]), rows(i));
  }
  Columns found(b.rows(), width);
  for (std::size_t k = 0; k < blocks.size(); ++k) found.middleRows<2>(2 * k) = x.middleRows<2>(2 * place[blocks[k]]);
  return found;
}

Vector BlockCholesky::solve(Vector b) const {
  SPREKK_EXPECT(b.size() == 2 * static_cast<Eigen::Index>(inverse_.size()), b.size(), inverse_.size());
  SPREKK_EXPECT(is_finite(b), b.size());
  const int n = static_cast<int>(inverse_.size());
  for (int i = 0; i < n; ++i) {
    const Point x = b.segment<2>(2 * i);
    for (int p = starts_[i]; p < starts_[i + 1]; ++p) b.segment<2>(2 * rows_[p]).noalias() -= lower_[p] * x;
  }
  for (int i = n - 1; i >= 0; --i) {
    Point x = inverse_[i] * b.segment<2>(2 * i);
    for (int p = starts_[i]; p < starts_[i + 1]; ++p) x.noalias() -= lower_[p].transpose() * b.segment<2>(2 * rows_[p]);
    b.segment<2>(2 * i) = x;
  }
  return b;
}

}  // namespace sprekk::fine_fracture
