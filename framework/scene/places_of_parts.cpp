#include "framework/scene/places_of_parts.hpp"

#include <algorithm>

#include "framework/assembly/lives_in_part.hpp"
#include "framework/assembly/property.hpp"

namespace sprekk {

bool PlacesOfParts::is_on_fractures(const Component& component) const {
  constexpr Location between_fractures[] = {Location::cell, Location::face, Location::node};
  bool has_fields = false;
  for (const auto& field : fields_.all()) {
    if (field->spec().owner != component.name()) continue;
    has_fields = true;
    if (std::ranges::count(between_fractures, field->spec().location) > 0) return false;
  }
  return has_fields;
}

std::vector<Place> PlacesOfParts::of(const std::vector<std::string>& names) const {
  std::vector<Place> places;
  for (const auto& component : components_) {
    if (std::ranges::count(names, component->name()) == 0) continue;
    const std::vector<Place> all = is_on_fractures(*component) ? fracture_cell_places(mesh_) : cell_places(mesh_);
    const auto* partial = dynamic_cast<const LivesInPart*>(component.get());
    const bool is_everywhere = !partial || partial->inhabited_cells().empty();
    for (std::size_t i = 0; i < all.size(); ++i)
      if (is_everywhere || partial->inhabited_cells()[i]) places.push_back(all[i]);
  }
  return places;
}

}  // namespace sprekk
