// Matrices that are made once and read often.
#pragma once

#include <cstdint>
#include <memory>

#include "framework/types.hpp"

namespace sprekk {

/// A sparse matrix that does not change. Each one made has a number of its own, which its copies share: who meets a
/// number again knows the entries without a look at them. Parts keep what stays for a mesh in such matrices, and what
/// they compute in each assembly in plain ones.
class Operator {
 public:
  Operator() : Operator(SparseMatrix()) {}
  explicit Operator(SparseMatrix entries);
  const SparseMatrix& entries() const { return *entries_; }
  /// Never 0.
  std::uint64_t number() const { return number_; }

 private:
  std::shared_ptr<const SparseMatrix> entries_;
  std::uint64_t number_;
};

/// Has exactly one entry in each row, zero or not.
SparseMatrix diagonal_matrix(const Vector& entries);

}  // namespace sprekk
