#include "framework/linear/gather_entries.hpp"

#include "framework/matrix_of.hpp"
#include "framework/parallel/parallel.hpp"

namespace sprekk {

SparseMatrix gather_entries(const std::vector<Triplet>& entries, int rows, int columns) {
  std::vector<int> row_of, column_of;
  std::vector<double> values;
  for (const Triplet& entry : entries) {
    row_of.push_back(entry.row());
    column_of.push_back(entry.col());
    values.push_back(entry.value());
  }
  row_of = parallel::gather(row_of);
  column_of = parallel::gather(column_of);
  values = parallel::gather(values);
  std::vector<Triplet> gathered;
  gathered.reserve(values.size());
  for (std::size_t k = 0; k < values.size(); ++k) gathered.emplace_back(row_of[k], column_of[k], values[k]);
  return matrix_of(rows, columns, gathered);
}

}  // namespace sprekk
