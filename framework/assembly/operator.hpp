// Matrices that are made once and read often.
#pragma once

#include <cstdint>
#include <memory>

#include "framework/types.hpp"

namespace sprekk {

/// A sparse matrix that does not change. Each one made has a number of its own, which its copies share: who meets a
/// number again knows the entries without a look at them. Parts keep what stays for a mesh in such matrices, and what
/// they compute in each assembly in plain ones.
///
/// Rows of balances may exchange something: what leaves one enters another, and in the sum of all rows it is absent,
/// but for the round-off of the entries. Who makes such a matrix knows what stays of it in the sum: the part that
/// leaves all of them together.
class Operator {
 public:
  Operator() : Operator(SparseMatrix()) {}
  explicit Operator(SparseMatrix entries);
  /// Of an exchange. The columns of `leaving`, of the same shape, add up to what those of `entries` would without
  /// round-off.
  Operator(SparseMatrix entries, SparseMatrix leaving);
  const SparseMatrix& entries() const { return *entries_; }
  bool is_exchange() const { return leaving_ != nullptr; }
  /// What counts in a sum of rows: all entries, if it is no exchange.
  const SparseMatrix& leaving() const { return leaving_ ? *leaving_ : *entries_; }
  /// The largest absolute entry of an exchange; 0 of others.
  double largest_exchange() const { return largest_exchange_; }
  /// Never 0.
  std::uint64_t number() const { return number_; }

 private:
  std::shared_ptr<const SparseMatrix> entries_, leaving_;
  double largest_exchange_ = 0;
  std::uint64_t number_;
};

/// Has exactly one entry in each row, zero or not.
SparseMatrix diagonal_matrix(const Vector& entries);

}  // namespace sprekk
