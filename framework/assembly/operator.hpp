// Matrices that are made once and read often.
#pragma once

#include <cstdint>
#include <memory>

#include "framework/types.hpp"

namespace sprekk {

/// A sparse matrix that does not change. Each has a unique number, which its copies share: the same number means the
/// same entries. Parts keep matrices that stay for a mesh as operators, and matrices that they compute in each assembly
/// as plain sparse matrices.
///
/// Rows of balances may exchange amounts: what leaves one row enters another, and cancels in the sum of all rows, but
/// for the round-off of the entries. Code that makes such a matrix also gives what stays in the sum: the amounts that
/// leave all rows together.
class Operator {
 public:
  Operator() : Operator(SparseMatrix()) {}
  explicit Operator(SparseMatrix entries);
  /// An exchange. `leaving` has the shape of `entries`, and its column sums are what those of `entries` would be
  /// without round-off.
  Operator(SparseMatrix entries, SparseMatrix leaving);
  /// An exchange between the rows of two fields. The matrix is in the rows of both, with opposite signs: nothing of it
  /// leaves the rows of both together. Both fields have to be solved together.
  static Operator between_fields(SparseMatrix entries);
  const SparseMatrix& entries() const { return *entries_; }
  bool is_exchange() const { return leaving_ != nullptr; }
  /// The matrix to use in a sum of rows; entries() if this is no exchange.
  const SparseMatrix& leaving() const { return leaving_ ? *leaving_ : *entries_; }
  /// The largest absolute entry of an exchange; 0 for other matrices.
  double largest_exchange() const { return largest_exchange_; }
  /// Never 0.
  std::uint64_t number() const { return number_; }

 private:
  void exchange(SparseMatrix leaving);

  std::shared_ptr<const SparseMatrix> entries_, leaving_;
  double largest_exchange_ = 0;
  std::uint64_t number_;
};

/// The square matrix with these entries on its diagonal. Zeros are stored as well: each row has exactly one entry.
SparseMatrix diagonal_matrix(const Vector& entries);

}  // namespace sprekk
