// A direct solver for a symmetric matrix of 2 x 2 blocks.
#pragma once

#include <Eigen/Core>
#include <vector>

#include "framework/types.hpp"

namespace sprekk::fine_fracture {

/// The upper triangle of a symmetric matrix of blocks, by columns: blocks (rows[k], c) for k from starts[c] to
/// starts[c + 1], rows ascending, the block on the diagonal last.
struct BlockMatrix {
  using Block = Eigen::Matrix2d;
  std::vector<int> starts{0}, rows;
  std::vector<Block> blocks;

  int count() const { return static_cast<int>(starts.size()) - 1; }
  /// The number of the block of a column in a row that it has.
  int find(int row, int column) const;
};

/// The factorization A = L D L^T with D of 2 x 2 blocks, row by row along the elimination tree (Davis, ACM Trans. Math.
/// Softw. 31 (2005) 587), in the given order of unknowns. For a fine level, with some thousand unknowns and blocks of
/// one size, this is faster than a factorization by scalars, and than the dense blocks of a supernodal method.
class BlockCholesky {
 public:
  /// Throws std::runtime_error when the matrix is not positive definite by more than rounding.
  explicit BlockCholesky(const BlockMatrix& matrix);
  /// Solves A x = b; two values for each block.
  Vector solve(Vector b) const;
  /// Solves for all columns at once, where b is zero outside of some blocks, and the solution is wanted in these alone:
  /// two rows of b and of the result for each of `blocks`; rows of b for the same block add up. Only the columns of L
  /// on their paths up the tree take part.
  using Columns = Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor>;
  Columns solve_within(const std::vector<int>& blocks, const Columns& b) const;

 private:
  using Block = BlockMatrix::Block;
  void find_tree(const BlockMatrix& matrix);
  void factorize(const BlockMatrix& matrix);
  void invert(int column, const Block& pivot, const Block& diagonal);

  std::vector<int> parent_, starts_, rows_;  ///< of L: below the diagonal, by columns
  std::vector<Block> lower_, inverse_;       ///< of L, and of D^-1
};

}  // namespace sprekk::fine_fracture
