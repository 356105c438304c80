#include "framework/mesh/shapes.hpp"

namespace sprekk {

const Shape* shape_with(int corners) {
  static const std::array<FaceNodes, 3> triangle{{{0, 1}, {1, 2}, {2, 0}}};
  static const std::array<FaceNodes, 4> quadrilateral{{{0, 1}, {1, 2}, {2, 3}, {3, 0}}};
  static const std::array<Shape, 2> all{{{"triangle", 3, triangle}, {"quadrilateral", 4, quadrilateral}}};
  return corners == 3 || corners == 4 ? &all[corners - 3] : nullptr;
}

CellFaces faces_to_number(const CellNodes& cell) { return cell; }

FaceNodes nodes_of_face(const CellNodes& cell, int k) { return {cell[k], cell.after(k)}; }

RidgeNodes ridge_of(const FaceNodes& face, int k) { return {face[k]}; }

FaceNodes reversed(const FaceNodes& face) { return {face[1], face[0]}; }

bool have_same_nodes(const FaceNodes& one, const FaceNodes& other) {
  return one == other || (one[0] == other[1] && one[1] == other[0]);
}

bool turn_alike(const FaceNodes& one, const FaceNodes& other) { return one[0] == other[0]; }

}  // namespace sprekk
