#include "framework/mesh/shapes.hpp"

#include <algorithm>

namespace sprekk {

const Shape* shape_with(int corners) {
  static const std::array<FaceNodes, 4> tetrahedron{{{0, 2, 1}, {0, 1, 3}, {1, 2, 3}, {0, 3, 2}}};
  static const std::array<FaceNodes, 5> wedge{{{0, 2, 1}, {3, 4, 5}, {0, 1, 4, 3}, {1, 2, 5, 4}, {2, 0, 3, 5}}};
  static const std::array<FaceNodes, 6> hexahedron{
      {{0, 3, 2, 1}, {4, 5, 6, 7}, {0, 1, 5, 4}, {1, 2, 6, 5}, {2, 3, 7, 6}, {3, 0, 4, 7}}};
  static const std::array<Shape, 3> all{
      {{"tetrahedron", 4, tetrahedron}, {"wedge", 6, wedge}, {"hexahedron", 8, hexahedron}}};
  const auto found = std::ranges::find(all, corners, &Shape::corners);
  return found == all.end() ? nullptr : &*found;
}

CellFaces faces_to_number(const CellNodes& cell) {
  CellFaces faces;
  for (std::size_t k = 0; k < shape_with(cell.size())->faces.size(); ++k) faces.push_back(-1);
  return faces;
}

FaceNodes nodes_of_face(const CellNodes& cell, int k) {
  FaceNodes nodes = shape_with(cell.size())->faces[k];
  for (int& node : nodes) node = cell[node];
  return nodes;
}

RidgeNodes ridge_of(const FaceNodes& face, int k) { return {face[k], face.after(k)}; }

FaceNodes reversed(const FaceNodes& face) {
  FaceNodes nodes = face;
  std::reverse(nodes.begin(), nodes.end());
  return nodes;
}

bool have_same_nodes(const FaceNodes& one, const FaceNodes& other) {
  return one.size() == other.size() && std::is_permutation(one.begin(), one.end(), other.begin());
}

bool turn_alike(const FaceNodes& one, const FaceNodes& other) {
  const auto same = std::find(other.begin(), other.end(), one[0]);
  return other.after(static_cast<int>(same - other.begin())) == one[1];
}

}  // namespace sprekk
