#include "framework/config/input_error.hpp"
#include "framework/mesh/raw_mesh.hpp"

namespace sprekk {

std::vector<FaceNodes> faces_of(const RawMesh& raw, const RawMesh::Fracture& fracture) {
  const auto& [name, chain] = fracture;
  if (chain.size() < 2) throw InputError("fracture '" + name + "' has no edge");
  for (const int node : chain)
    if (node < 0 || node >= static_cast<int>(raw.nodes.size()))
      throw InputError("fracture '" + name + "' names node " + std::to_string(node) + ", which does not exist");
  std::vector<FaceNodes> faces;
  for (std::size_t i = 0; i + 1 < chain.size(); ++i) faces.push_back({chain[i], chain[i + 1]});
  return faces;
}

RawMesh::Fracture fracture_with(const std::string& name, const std::vector<FaceNodes>& faces) {
  RawMesh::Chain chain{name, {faces.front()[0]}};
  for (const FaceNodes& face : faces) chain.nodes.push_back(face[1]);
  return chain;
}

}  // namespace sprekk
