// A sparse matrix whose rows, and whose operand, are distributed over the processes.
#pragma once

#include <memory>
#include <vector>

#include "framework/types.hpp"

namespace sprekk {

/// A rectangular Tpetra matrix behind plain vectors.
class DistributedMatrix {
 public:
  /// `rows`: this process's rows, columns global. `row_ids`, `column_ids`: global numbers of the rows that this process
  /// holds of the result, and of the entries that it holds of the operand. Collective.
  DistributedMatrix(const SparseMatrix& rows, const std::vector<int>& row_ids, const std::vector<int>& column_ids,
                    int row_count);
  ~DistributedMatrix();
  DistributedMatrix(DistributedMatrix&&) noexcept;
  DistributedMatrix& operator=(DistributedMatrix&&) noexcept;

  /// y -= A x on this process's entries. Collective.
  void subtract_product(const Vector& x, Vector& y) const;

 private:
  struct Data;
  std::unique_ptr<Data> data_;
};

}  // namespace sprekk
