// The unknowns of a fine level: which displacements are prescribed, and which are tied across a crack.
#pragma once

#include <vector>

#include "components/fine_fracture/fine_level/loads.hpp"
#include "components/fine_fracture/quarter_point/mesh/fine_mesh.hpp"

namespace sprekk::fine_fracture {

/// The map u = T x + g: each component of a displacement is one of the unknowns x (or none) plus a prescribed value.
class Unknowns {
 public:
  Unknowns(const FineGeometry& geometry, const FineMesh& mesh);

  int count() const { return count_; }
  /// The unknown of component 2 node + direction, or none.
  int of(int component) const { return unknown_[component]; }
  /// The prescribed part g of the displacements, m.
  Vector prescribed_values(const FineMesh& mesh, const FineLoads& loads) const;

 private:
  /// A node whose displacement is prescribed.
  struct Prescribed {
    int node;
    Point inside;  ///< see FineLoads::boundary_displacement
  };
  /// u(slave) = u(master) + sign jump.
  struct Tie {
    int slave, master;
    double sign;
    int wall_edge;
  };
  void prescribe_sides(const FineGeometry& geometry, const FineMesh& mesh);
  void tie_walls(const FineMesh& mesh);
  void pin_floating_parts(const FineMesh& mesh);
  void number(const FineMesh& mesh);

  std::vector<Prescribed> prescribed_;
  std::vector<Tie> ties_;
  std::vector<char> is_prescribed_;  ///< by node
  std::vector<char> is_slave_;       ///< by node
  std::vector<int> pinned_;          ///< components
  std::vector<int> unknown_;
  int count_ = 0;
};

}  // namespace sprekk::fine_fracture
