#include "framework/linear/trilinos_module/trilinos_module.hpp"
#include "framework/module/module.hpp"
#include "framework/parallel/parallel.hpp"

namespace sprekk {

const TrilinosModule& trilinos() {
  parallel::start_mpi();
  return module<TrilinosModule>("trilinos");
}

}  // namespace sprekk
