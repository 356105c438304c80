// What the scene gives in a step: forces on the coefficients of the displacement, and displacements.
#pragma once

#include <vector>

#include "components/poromechanics/excavation.hpp"
#include "components/poromechanics/fem/fem_operators.hpp"
#include "framework/assembly/step_time.hpp"

namespace sprekk::poromechanics {

/// The loads that the scene gives, in the numbering of RawDisplacement.
struct GivenLoads {
  /// The work of tractions on sides, of the weight and of the body force, less that of the initial stress, N/m (N in
  /// space).
  Vector forces;
  /// Along held axes (HeldDirections), m; 0 elsewhere. Of an edge and a face it is the coefficient of its function.
  Vector displacements;
  /// See PoroelasticRock::largest_load, Pa.
  double largest_stress = 0;
};

/// `settled`: the forces of the stress of every cell in a state that was settled (settled_forces), which replaces the
/// initial stress; or nullptr. Throws DataError.
GivenLoads given_loads(const Options& options, const RawDisplacement& raw, const Held& held,
                       const FemOperators& operators, const Excavation& excavation, const Vector* settled,
                       const StepTime& step);

/// The forces of the total stress of every cell on the functions of its corners and faces (RawDisplacement::of_cell),
/// cell after cell, N/m (N in space). `coefficients`: all of them, m; `pore_stress`: what pore pressures add to the
/// normal components of each cell, Pa. With the forces of springs. For the second order.
Vector settled_forces(const Options& options, const RawDisplacement& raw, const std::vector<Stiffness>& stiffness,
                      const FemOperators& operators, const Springs& springs, const Vector& coefficients,
                      const Vector& pore_stress);

}  // namespace sprekk::poromechanics
