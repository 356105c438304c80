// Makes the multigrid cycle of TrilinosModule::multigrid, which says what the arguments are.
#pragma once

#include "framework/linear/trilinos_module/trilinos_module.hpp"

namespace sprekk {

std::unique_ptr<Multigrid> make_multigrid(const SparseMatrix& rows, const std::vector<int>& ids,
                                          const UnknownBlock& block);

}  // namespace sprekk
