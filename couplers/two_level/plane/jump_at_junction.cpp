#include "couplers/two_level/plane/jump_at_junction.hpp"

#include "couplers/two_level/plane/straight_piece.hpp"

namespace sprekk::couplers {

JumpAtJunction::JumpAtJunction(const Mesh& mesh, const Junction& junction) {
  for (const int index : junction.cells) {
    const FractureCell& cell = mesh.fracture_cells[index];
    const Point& position = mesh.ridges[junction.ridges[0]].center;
    const bool leads_here = (position - cell.center).dot(cell.tangents) > 0;
    // The plus side is to the left along the tangent.
    Arm arm{index, none, 0, leads_here ? 1.0 : -1.0, cell};
    const int behind = leads_here ? index - 1 : index + 1;
    if (leads_here ? is_straight_on(mesh, behind) : is_straight_on(mesh, index)) {
      arm.behind = behind;
      arm.share = cell.measure / (cell.measure + mesh.fracture_cells[behind].measure);
    }
    arms_.push_back(arm);
  }
}

Point JumpAtJunction::at_end(const Arm& arm, const Vector& jumps) {
  Point local = jumps.segment<dimension>(dimension * arm.cell);
  if (arm.behind != none) local += arm.share * (local - Point(jumps.segment<dimension>(dimension * arm.behind)));
  return arm.frame.to_global(local);
}

Point JumpAtJunction::of(int cell, const Vector& jumps) const {
  Point left_over = Point::Zero(), own = Point::Zero();
  for (const Arm& arm : arms_) {
    const Point jump = at_end(arm, jumps);
    left_over += arm.sign * jump;
    if (arm.cell == cell) own = jump;
  }
  for (const Arm& arm : arms_)
    if (arm.cell == cell) own -= arm.sign / static_cast<double>(arms_.size()) * left_over;
  return own;
}

}  // namespace sprekk::couplers
