// Displacement jumps where fractures meet.
#pragma once

#include <vector>

#include "framework/mesh/mesh.hpp"

namespace sprekk::couplers {

/// On the way around a junction all jumps add up to zero, since the displacement comes back to what it was: the
/// piecewise linear jumps of cells do so only to the order of their length. Those that lines through the centres of two
/// cells (of one, where it is alone on its straight piece) have at the junction are changed by equal parts of what is
/// left over, so that the rock does not part where fractures meet.
class JumpAtJunction {
 public:
  JumpAtJunction(const Mesh& mesh, const Junction& junction);

  /// m, at the junction on a cell that meets there, in global components. `jumps` are the (normal, tangential) ones of
  /// all fracture cells.
  Point of(int cell, const Vector& jumps) const;

 private:
  /// One of the cells and the one behind it, or none where that is on another straight piece.
  struct Arm {
    int cell, behind;
    double share;  ///< of the difference to the one behind that is between the centre and the junction
    double sign;   ///< of the jump on the way around, counter-clockwise
    Point normal, tangent;
  };
  static Point at_end(const Arm& arm, const Vector& jumps);

  std::vector<Arm> arms_;
};

}  // namespace sprekk::couplers
