#include "components/poromechanics/stress_operators.hpp"

namespace sprekk::poromechanics {

void StressOperators::swap(StressOperators& other) {
  for (SparseMatrix StressOperators::*matrix :
       {&StressOperators::force_displacement, &StressOperators::force_stress, &StressOperators::force_boundary,
        &StressOperators::trace_displacement, &StressOperators::trace_stress, &StressOperators::trace_boundary,
        &StressOperators::volume_displacement, &StressOperators::volume_stress, &StressOperators::volume_boundary,
        &StressOperators::moment_displacement})
    (this->*matrix).swap(other.*matrix);
}

}  // namespace sprekk::poromechanics
