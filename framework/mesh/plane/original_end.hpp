// Where the ends of a fracture were before it has grown.
#pragma once

#include "framework/mesh/mesh.hpp"

namespace sprekk {

/// The end of that part of a fracture that has not grown, m: it stays where it is while the fracture grows.
inline const Point& original_end(const Mesh& mesh, int fracture, bool at_end) {
  const auto& [name, first, count] = mesh.fractures[fracture];
  const auto cell_from_end = [&](int i) -> const FractureCell& {
    return mesh.fracture_cells[first + (at_end ? count - 1 - i : i)];
  };
  int i = 0;
  while (i + 1 < count && cell_from_end(i).grown) ++i;
  return mesh.ridges[cell_from_end(i).ridges[at_end ? 1 : 0]].center;
}

}  // namespace sprekk
