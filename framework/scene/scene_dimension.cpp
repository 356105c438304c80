#include "framework/scene/scene_dimension.hpp"

#include "framework/types.hpp"

namespace sprekk {

int dimension_of(const Node& scene) {
  const Node* place = &scene;
  for (const char* key : {"geometry", "box", "z"}) {
    place = place->is_map() ? place->find(key) : nullptr;
    if (!place) return 2;
  }
  return 3;
}

void require_dimension(const Node& scene) {
  if (const int wanted = dimension_of(scene); wanted != dimension) throw OtherDimension{wanted};
}

}  // namespace sprekk
