// What the scene gives in a step: forces on the coefficients of the displacement, and displacements.
#pragma once

#include <vector>

#include "components/poromechanics/fem/fem_operators.hpp"
#include "framework/assembly/step_time.hpp"

namespace sprekk::poromechanics {

/// In the numbering of RawDisplacement.
struct GivenLoads {
  /// The work of tractions on sides, of the weight and of the body force, less that of the initial stress, N/m.
  Vector forces;
  /// Along held axes (HeldDirections), m; 0 elsewhere. Of a face it is the coefficient of its function.
  Vector displacements;
  /// See PoroelasticRock::largest_load, Pa.
  double largest_stress = 0;
};

/// Throws DataError.
GivenLoads given_loads(const Options& options, const Mesh& mesh, const Held& held, const FemOperators& operators,
                       const StepTime& step);

}  // namespace sprekk::poromechanics
