// Makes the GMRES of TrilinosModule::gmres, which says what the arguments are.
#pragma once

#include "framework/linear/trilinos_module/trilinos_module.hpp"

namespace sprekk {

std::unique_ptr<Gmres> make_gmres(const SparseMatrix& rows, const std::vector<int>& ids,
                                  std::function<void(const Vector&, Vector&)> precondition, int basis);

}  // namespace sprekk
