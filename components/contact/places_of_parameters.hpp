// Where a contact evaluates its parameters.
#pragma once

#include <algorithm>
#include <vector>

#include "framework/assembly/property.hpp"

namespace sprekk::contact {

/// The place of each fracture cell that the contact is on (`here`, one flag a cell; none for all). All other fracture
/// cells get the place of the first of these, and their values are not used. So a scene need not give parameters for
/// fractures without this contact.
inline std::vector<Place> places_of_parameters(const Mesh& mesh, const std::vector<char>& here) {
  std::vector<Place> places = fracture_cell_places(mesh);
  if (here.empty()) return places;
  const auto first = std::ranges::find(here, 1) - here.begin();
  for (std::size_t i = 0; i < places.size(); ++i)
    if (!here[i]) places[i] = places[first];
  return places;
}

}  // namespace sprekk::contact
