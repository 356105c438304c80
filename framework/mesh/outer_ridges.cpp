#include "framework/mesh/outer_ridges.hpp"

#include <algorithm>
#include <stdexcept>
#include <string>

#include "framework/config/input_error.hpp"
#include "framework/mesh/geometry.hpp"
#include "framework/mesh/mesh.hpp"

namespace sprekk {

RidgeNodes sorted(RidgeNodes ridge) {
  std::ranges::sort(ridge);
  return ridge;
}

OuterRidges::OuterRidges(const RawMesh& raw, const FaceTable& faces) : side_of_face_(faces.size(), none) {
  const std::string what = face_name, has_a = (dimension == 2 ? " has an " : " has a ") + what;
  const auto middle = [&](int face) { return to_text(face_geometry(raw.nodes, faces.nodes(face)).center); };
  for (const auto& [nodes, side] : raw.boundary_faces) {
    if (side < 0 || side >= static_cast<int>(raw.side_names.size()))
      throw std::logic_error("raw mesh: side " + std::to_string(side) + " has no name");
    const std::string name = "side '" + raw.side_names[side] + "'";
    const int face = faces.find(nodes);
    if (face == none) {
      throw InputError(name + has_a + " that no cell has (between nodes " + std::to_string(nodes[0]) + " and " +
                       std::to_string(nodes[1]) + ")");
    }
    if (!faces.is_outer(face)) throw InputError(name + has_a + " inside the mesh at " + middle(face));
    int& known = side_of_face_[face];
    if (known != none && known != side) {
      throw InputError("the " + what + " at " + middle(face) + " belongs to two sides ('" + raw.side_names[known] +
                       "' and '" + raw.side_names[side] + "')");
    }
    known = side;
  }
  for (int face = 0; face < faces.size(); ++face) {
    if (!faces.is_outer(face)) continue;
    const FaceNodes& nodes = faces.nodes(face);
    const int side = side_of_face_[face];
    if (side == none) throw InputError("the outer " + what + " at " + middle(face) + " belongs to no side");
    for (int k = 0; k < static_cast<int>(nodes.size()); ++k) {
      AtRidge& ridge = ridges_[sorted(ridge_of(nodes, k))];
      ridge.side = ridge.faces++ == 0 ? side : std::min(ridge.side, side);
    }
  }
  for (const auto& [ridge, at] : ridges_) {
    if (at.faces > 2) {
      throw InputError("the outer boundary touches itself at " + to_text(ridge_geometry(raw.nodes, ridge).center) +
                       " (cells meet there in one " + (dimension == 2 ? "node" : "edge") + " only)");
    }
  }
}

}  // namespace sprekk
