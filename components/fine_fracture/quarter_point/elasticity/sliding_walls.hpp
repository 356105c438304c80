// Walls that slide and part on the fine level.
#pragma once

#include <functional>
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
  /// The displacement by the tractions that close the gaps, (x, y) per node, m. `without`: that without these;
  /// `responses`: the displacements by nodal forces alone, a column each. Throws std::runtime_error where no state is
  /// found.
  Vector displacement(const Vector& without,
                      const std::function<Eigen::MatrixXd(const Eigen::MatrixXd& forces)>& responses) const;

 private:
  struct Edge {
    const FineMesh::WallEdge* edge;
    std::array<int, 2> places;  ///< of its ends, in f
    TipSurroundings::Sliding law;
  };
  Vector gaps(const Vector& displacement, bool with_opening) const;
  Vector unit_force(int place) const;

  const FineMesh& mesh_;
  std::vector<Edge> edges_;
  int count_ = 0;
};

}  // namespace sprekk::fine_fracture
