// The notes of the rock, for any discretization.
#pragma once

#include <string>
#include <vector>

#include "components/poromechanics/options.hpp"
#include "components/poromechanics/stiffness.hpp"
#include "framework/assembly/notes.hpp"
#include "framework/mesh/mesh.hpp"

namespace sprekk::poromechanics {

/// Notes data without effect. `name`, `origin`: of the component in the scene.
void note_conditions(Notes& notes, const Options& options, const Mesh& mesh, const std::string& name,
                     const Origin& origin);

/// The largest change of the displacement over a distance, and where it is.
struct LargestStrain {
  double strain = 0;
  Point place = Point::Zero();
};

/// Notes a strain above `large_strain`, except in rock so soft that the scene must be dimensionless.
void note_large_strain(Notes& notes, const std::string& name, const LargestStrain& largest, const Options& options,
                       const std::vector<Stiffness>& stiffness);

}  // namespace sprekk::poromechanics
