#include "framework/scene/scene_dimension.hpp"

#include <filesystem>
#include <initializer_list>

#include "framework/meshing/read_msh.hpp"
#include "framework/types.hpp"

namespace sprekk {
namespace {

const Node* find_at(const Node& scene, std::initializer_list<const char*> keys) {
  const Node* place = &scene;
  for (const char* key : keys) place = place && place->is_map() ? place->find(key) : nullptr;
  return place;
}

}  // namespace

int dimension_of(const Node& scene, const std::string& folder) {
  if (find_at(scene, {"geometry", "box", "z"})) return 3;
  const Node* const file = find_at(scene, {"geometry", "file"});
  return file && file->is_scalar() ? dimension_of_mesh_file(std::filesystem::path(folder) / file->scalar) : 2;
}

void require_dimension(const Node& scene, const std::string& folder) {
  if (const int wanted = dimension_of(scene, folder); wanted != dimension) throw OtherDimension{wanted};
}

}  // namespace sprekk
