// What parts of a mesh measure.
#pragma once

#include "framework/mesh/mesh.hpp"

namespace sprekk::test {

/// The area of a fracture, m^2.
inline double area_of(const Mesh& mesh, int fracture) {
  double area = 0;
  const auto& [name, first, count] = mesh.fractures[fracture];
  for (int i = first; i < first + count; ++i) area += mesh.fracture_cells[i].measure;
  return area;
}

/// The volume of a region, m^3.
inline double volume_of(const Mesh& mesh, int region) {
  double volume = 0;
  for (int c = 0; c < mesh.cell_count(); ++c) volume += mesh.cell_region[c] == region ? mesh.cell_measure[c] : 0;
  return volume;
}

}  // namespace sprekk::test
