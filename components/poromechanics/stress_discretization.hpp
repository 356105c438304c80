// What a discretization of the stress does for the rock.
#pragma once

#include <vector>

#include "components/poromechanics/stiffness.hpp"
#include "components/poromechanics/stress_operators.hpp"
#include "framework/mesh/mesh_change.hpp"

namespace sprekk::poromechanics {

/// The input of a discretization. A face with two cells has the condition `load` in both directions, or none.
struct StressInputs {
  const Mesh& mesh;
  const std::vector<Stiffness>& stiffness;        ///< one a cell
  const std::vector<FaceConditions>& conditions;  ///< one a face
};

/// The operators of a mesh that has changed, and how much was computed for them.
struct Rediscretized {
  StressOperators operators;
  int regions, cells;  ///< local problems that were solved, and cells that they touch
};

/// A discretization of the stress (MPSA is one), as the balance of forces uses it.
struct StressDiscretization {
  /// `nodes`: one flag a node, around which the local problems are to be solved; empty for all. Rows of other nodes
  /// stay zero.
  StressOperators (*discretize)(const StressInputs& inputs, const std::vector<char>& nodes);
  /// The same bits as `discretize` for `after` around all nodes. Computes only rows that have changed, and takes all
  /// others from the operators for `before`. In one process only.
  Rediscretized (*rediscretize)(const StressInputs& before, const StressOperators& operators, const StressInputs& after,
                                const MeshChange& change);
};

}  // namespace sprekk::poromechanics
