// Which entries of a system belong to the bulk and which to the local unknowns on fractures.
#pragma once

#include <utility>
#include <vector>

#include "framework/linear/linear_solver.hpp"
#include "framework/linear/reduction/excerpt.hpp"
#include "framework/parallel/gathered.hpp"

namespace sprekk {

/// The part of a matrix with rows of one kind and columns of one kind.
struct SubMatrix {
  SparseMatrix matrix;
  Excerpt source;  ///< the places of the values among those of the whole matrix

  bool differs(const double* values) const { return source.differs(values, matrix.valuePtr()); }
  /// Takes the values over.
  void update(const double* values) { source.take(values, matrix.valuePtr()); }
  bool has_row(int row) const { return matrix.outerIndexPtr()[row + 1] > matrix.outerIndexPtr()[row]; }
};

/// Splits the unknowns of a system into B (bulk) and F (BlockKind::interface), each in their order, and the matrix into
/// four blocks. Of A_BB and A_BF a process has the rows of its own; of A_FB and A_FF every process has all rows, since
/// they are few. All calls are collective. A splitting can be used as long as the sparsity pattern stays. `held`: for
/// every unknown, whether it belongs to F although it is one of the bulk (unknowns_held_by_fractures): all unknowns of
/// an entity, or none of them; an empty vector stands for none at all.
class BulkSplitting {
 public:
  explicit BulkSplitting(const LinearSystem& system, std::vector<char> held = {});
  bool fits(const SparseMatrix& matrix) const;

  const std::vector<char>& held() const { return held_; }
  int bulk_size() const { return bulk_.local.cols(); }
  int local_size() const { return ff.matrix.rows(); }
  /// Whether an unknown of F is one of the bulk (`held`); whether there are any.
  bool is_held(int unknown) const { return is_held_local_[unknown]; }
  bool has_held() const { return !is_held_local_.empty(); }
  /// Of a vector of this process's rows: those of B, and all of F.
  Vector bulk_part(const Vector& rows) const;
  Vector local_part(const Vector& rows) const;
  /// A vector of all unknowns, from all of B and F.
  Vector joined(const Vector& bulk, const Vector& local) const;
  /// All of B, from this process's rows.
  Vector whole_bulk(const Vector& mine) const { return whole_bulk_.whole(mine); }
  /// The equations of the bulk as a system of their own, with A_BB.
  const LinearSystem& bulk_system() const { return bulk_; }
  const SparseMatrix& bb() const { return bulk_.local; }
  /// The number of the bulk's system: one that no other bulk has whose values differ (new_telling_number).
  void number_bulk(std::uint64_t number) { bulk_.number = number; }
  /// A matrix of F as a system of its own; it is whole.
  LinearSystem local_system(SparseMatrix matrix) const;
  LinearSystem whole_system() const;
  /// Whether the bits of a value of A_BB or A_BF differ in a matrix that fits, on this process.
  bool has_other_bulk(const SparseMatrix& matrix) const;
  /// Whether values of the bulk may differ from those that it has.
  enum class Bulk { changes, stays };
  /// Takes the values of a matrix that fits; those of A_BB and A_BF only if they change on some process.
  void update(const SparseMatrix& matrix, Bulk bulk = Bulk::changes);
  /// Which rows are sums of balances (LinearSystem::sums); belongs to the values, not to the pattern.
  void take_sums(const std::vector<int>& sums);
  /// The largest over the blocks of max |b − A x| / max (|A| |x| + |b|), with maxima over the rows of a block. Where
  /// the terms of a block are nothing but round-off of local unknowns, 1e-4 of the terms of these unknowns' own rows
  /// stand in the denominator. `b_bulk`: of this process's rows; the other vectors are whole.
  double backward_error(const Vector& bulk, const Vector& local, const Vector& b_bulk, const Vector& b_local) const;

  SubMatrix bf, fb, ff;
  std::vector<int> bulk_rows, local_rows;  ///< the unknowns of B, and of F, whose rows are this process's
  std::vector<int> interface_columns;      ///< the local unknowns that have a column in A_BF
  std::vector<int> interface_rows;         ///< the local rows that have an entry in A_FB
  std::vector<int> near;                   ///< the unknowns of the bulk that have a column in A_FB
  std::vector<int> near_place;             ///< of every unknown of the bulk: its place in `near`, or -1

 private:
  /// Rows of a matrix: where each begins and ends among its entries.
  struct Rows {
    std::vector<std::pair<int, int>> spans;
    void add(int begin, int end) { spans.emplace_back(begin, end); }
  };
  void split_own_rows(int bulk, int local);
  void split_rows_of_all(int bulk, int local);
  SubMatrix extract(const Rows& rows, const std::vector<int>& column_of, bool local_columns, int width) const;

  std::vector<int> rows_;  ///< of this process
  std::vector<int> outer_, inner_;
  std::vector<int> of_local_rows_;  ///< places of the entries of this process's rows of F
  std::vector<double> values_of_local_rows_;
  std::vector<char> held_;
  std::vector<char> is_local_;       ///< of every unknown
  std::vector<char> is_held_local_;  ///< of every unknown of F; empty for none
  std::vector<int> place_;           ///< of every unknown: its number among those of its kind
  std::vector<UnknownBlock> blocks_, local_blocks_;
  LinearSystem bulk_;
  Excerpt of_bulk_;  ///< the places of the values of A_BB
  std::vector<int> sums_;
  parallel::WholeVectors whole_bulk_, whole_local_;
};

}  // namespace sprekk
