// Where and along which directions the displacement is prescribed.
#pragma once

#include <algorithm>
#include <functional>
#include <vector>

#include "components/poromechanics/fem/raw_displacement.hpp"
#include "components/poromechanics/options.hpp"
#include "framework/mesh/mesh.hpp"

namespace sprekk::poromechanics {

/// Which share of a condition's value is prescribed along a direction: condition direction `axis` of an outer face, or
/// of a pinned point.
struct HeldBy {
  int face, axis;
  double share;
  const PinnedPoint* pin = nullptr;
};

/// The directions in which a node or a face is held. `axes`: orthonormal columns, of which those flagged by `is_held`
/// are prescribed: the column is the direction that is nearest to the coordinate of its number. The displacement along
/// column k is the sum of share · value over by[k].
struct HeldDirections {
  Tensor axes = Tensor::Identity();
  bool is_held[dimension] = {};
  std::vector<HeldBy> by[dimension];
  bool is_free() const { return std::ranges::none_of(is_held, std::identity{}); }
};

/// Of each node, edge and face. A node, or an edge, on two faces of one side, which may be curved, is held along the
/// mean of their directions, weighted by length or area: else it would stick (consistent normals, Engelman, Sani and
/// Gresho 1982). At corners of different directions both hold.
struct Held {
  std::vector<HeldDirections> nodes, edges, faces;
  /// In the numbering of RawDisplacement.
  const HeldDirections& of_entity(int entity) const;
};
/// `edges`: those with functions.
Held held_directions(const Options& options, const Mesh& mesh, const CellEdges& edges = {});

}  // namespace sprekk::poromechanics
