// Displacement jumps where fractures meet.
#pragma once

#include <vector>

#include "framework/mesh/mesh.hpp"

namespace sprekk::couplers {

/// Extrapolates jumps to a junction so that the displacement there is continuous. Then all jumps on a path around the
/// junction add up to zero. Jumps that are extrapolated from the centres of cells (linearly from two, or as a constant
/// where a cell is alone on its straight piece) do so only to the order of the cell length, so their sum is subtracted
/// from them in equal parts.
class JumpAtJunction {
 public:
  JumpAtJunction(const Mesh& mesh, const Junction& junction);

  /// The jump at the junction on one of its cells, m, in global components. `jumps`: (normal, tangential) of all
  /// fracture cells.
  Point of(int cell, const Vector& jumps) const;

 private:
  /// A cell at the junction and the cell behind it, or none where that cell is on another straight piece.
  struct Arm {
    int cell, behind;
    double share;        ///< distance from the centre to the junction over that to the centre of the cell behind
    double sign;         ///< of the jump on the way around, counter-clockwise
    FractureCell frame;  ///< the cell, for its normal and tangent
  };
  static Point at_end(const Arm& arm, const Vector& jumps);

  std::vector<Arm> arms_;
};

}  // namespace sprekk::couplers
