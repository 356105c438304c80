// A discretization of the flux on a mesh that has changed in a few places.
#pragma once

#include <functional>
#include <type_traits>

#include "components/matrix_flow/flux_operators.hpp"
#include "framework/mesh/mesh_change.hpp"

namespace sprekk::matrix_flow {

/// A discretization of the flux: see discretize_mpfa.
using Discretize = std::function<std::remove_pointer_t<DiscretizeFlux>>;

/// The arguments of a discretization of the flux, for all nodes.
struct FlowInputs {
  const Mesh& mesh;
  const std::vector<Tensor>& mobility;
  const std::vector<FlowCondition>& conditions;
};

/// Operators on the new mesh, and how much was computed.
struct Rediscretized {
  FluxOperators operators;
  int regions, cells;  ///< local problems that were solved, and cells that they touch
};

/// The operators that `discretize` gives for `after`, to the bit, from those that it gave for `before`: local problems
/// are solved only around nodes where an input differs (KeptRegions). In one process. A row of the operators must
/// depend only on the surroundings of the nodes of its face, and near a tip on those of the tip (cells_around_tips).
Rediscretized rediscretize(Discretize discretize, const FlowInputs& before, const FluxOperators& operators,
                           const FlowInputs& after, const MeshChange& change);

}  // namespace sprekk::matrix_flow
