// A discretization of the flux on a mesh that has changed in a few places.
#pragma once

#include "components/matrix_flow/flux_operators.hpp"
#include "framework/mesh/mesh_change.hpp"

namespace sprekk::matrix_flow {

/// A discretization of the flux: see discretize_mpfa.
using Discretize = FluxOperators (*)(const Mesh&, const std::vector<Tensor>&, const std::vector<FlowCondition>&,
                                     const std::vector<char>&);

/// Its arguments, for all nodes.
struct FlowInputs {
  const Mesh& mesh;
  const std::vector<Tensor>& mobility;
  const std::vector<FlowCondition>& conditions;
};

struct Rediscretized {
  FluxOperators operators;
  int regions, cells;  ///< local problems that were solved, and cells that they touch
};

/// What `discretize` gives for `after`, to the bit, from the operators that it gave for `before`: local problems are
/// solved only around nodes where an input differs (KeptRegions). In one process. The discretization reads, for a row,
/// nothing but what lies around the nodes of its face, and near a tip around that (cells_around_tips).
Rediscretized rediscretize(Discretize discretize, const FlowInputs& before, const FluxOperators& operators,
                           const FlowInputs& after, const MeshChange& change);

}  // namespace sprekk::matrix_flow
