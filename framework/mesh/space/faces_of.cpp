#include <map>

#include "framework/config/input_error.hpp"
#include "framework/mesh/geometry.hpp"
#include "framework/mesh/outer_ridges.hpp"
#include "framework/mesh/raw_mesh.hpp"

namespace sprekk {
std::vector<FaceNodes> faces_of(const RawMesh& raw, const RawMesh::Fracture& fracture) {
  const auto& [name, given] = fracture;
  if (given.empty()) throw InputError("fracture '" + name + "' has no face");
  std::map<RidgeNodes, std::vector<std::size_t>> at_ridge;
  for (std::size_t i = 0; i < given.size(); ++i) {
    for (const int node : given[i])
      if (node < 0 || node >= static_cast<int>(raw.nodes.size()))
        throw InputError("fracture '" + name + "' names node " + std::to_string(node) + ", which does not exist");
    for (int k = 0; k < given[i].size(); ++k) at_ridge[sorted(ridge_of(given[i], k))].push_back(i);
  }
  // From neighbour to neighbour, each edge is passed in opposite directions; parts that are not connected face the way
  // of the first.
  std::vector<FaceNodes> faces = given;
  std::vector<char> is_turned(given.size(), 0);
  const auto passes = [&](std::size_t face, const RidgeNodes& ridge) {
    for (int k = 0; k < faces[face].size(); ++k)
      if (ridge_of(faces[face], k) == ridge) return true;
    return false;
  };
  const Point first = face_geometry(raw.nodes, faces[0]).normal;
  for (std::size_t start = 0; start < faces.size(); ++start) {
    if (is_turned[start]) continue;
    if (first.dot(face_geometry(raw.nodes, faces[start]).normal) < 0) faces[start] = reversed(faces[start]);
    std::vector<std::size_t> front{start};
    is_turned[start] = 1;
    while (!front.empty()) {
      const std::size_t face = front.back();
      front.pop_back();
      for (int k = 0; k < faces[face].size(); ++k) {
        const RidgeNodes ridge = ridge_of(faces[face], k);
        for (const std::size_t other : at_ridge.at(sorted(ridge))) {
          if (is_turned[other]) continue;
          if (passes(other, ridge)) faces[other] = reversed(faces[other]);
          is_turned[other] = 1;
          front.push_back(other);
        }
      }
    }
  }
  return faces;
}

RawMesh::Fracture fracture_with(const std::string& name, const std::vector<FaceNodes>& faces) { return {name, faces}; }

}  // namespace sprekk
