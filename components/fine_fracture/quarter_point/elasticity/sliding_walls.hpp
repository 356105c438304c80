// Walls that slide and part on the fine level.
#pragma once

#include <array>
#include <functional>
#include <optional>
#include <vector>

#include "components/fine_fracture/fine_level/loads.hpp"
#include "components/fine_fracture/quarter_point/mesh/fine_mesh.hpp"

namespace sprekk::fine_fracture {

/// The law of an edge of the mesh, if its walls slide. Edges of rosettes do not: their walls are open.
std::optional<TipSurroundings::Sliding> sliding_of(const FineMesh& mesh, const FineMesh::WallEdge& edge,
                                                   const FineLoads& loads);

/// The normal tractions f of walls that slide, linear along their edges, and their gaps. With the hat functions phi of
/// the ends of edges,
///   G_i = int phi_i (g·[u] - opening) ds,   f_i <= 0,  G_i >= 0,  f_i G_i = 0.
class SlidingContact {
 public:
  SlidingContact(const FineMesh& mesh, const FineLoads& loads);
  bool is_empty() const { return count_ == 0; }
  /// The components of displacements (2 node + direction) on both walls.
  const std::vector<int>& components() const { return components_; }
  /// The nodal forces in these components (N/m) by the tractions that close the gaps; nothing where all walls part.
  /// `without`: the displacement without these, (x, y) per node, m; `responses`: the displacements in the components by
  /// nodal forces in them, a column each. Throws UnsolvedGrowth where no state is found.
  std::optional<Vector> forces(const Vector& without,
                               const std::function<Eigen::MatrixXd(const Eigen::MatrixXd& forces)>& responses) const;

 private:
  struct Edge {
    const FineMesh::WallEdge* edge;
    std::array<int, 2> places;                ///< of its ends, in f
    std::array<std::array<int, 3>, 2> nodes;  ///< by Wall: the first of the two components of each, in components_
    TipSurroundings::Sliding law;
  };
  /// The gaps by displacements in the components.
  Vector gaps(const Vector& displacement, bool with_opening) const;
  /// The nodal forces of f = 1 at each place, a column each.
  Eigen::MatrixXd unit_forces() const;

  const FineMesh& mesh_;
  std::vector<Edge> edges_;
  std::vector<int> components_;
  int count_ = 0;
};

}  // namespace sprekk::fine_fracture
