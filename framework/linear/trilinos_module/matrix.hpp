// Makes the distributed matrix of TrilinosModule::matrix, which says what the arguments are.
#pragma once

#include "framework/linear/trilinos_module/trilinos_module.hpp"

namespace sprekk {

std::unique_ptr<DistributedMatrix> make_distributed_matrix(const SparseMatrix& rows, const std::vector<int>& row_ids,
                                                           const std::vector<int>& column_ids, int row_count);

}  // namespace sprekk
