// What the components of vectors and tensors are called.
#pragma once

#include <string>
#include <vector>

#include "framework/types.hpp"

namespace sprekk {

/// Names of the components of a field in the coordinates of the scene, by their number: x, y for a vector, xx, yy, xy
/// for a symmetric tensor (symmetric_axes), 1, 2, … for other fields, none for a scalar.
inline std::vector<std::string> component_names(int components) {
  std::vector<std::string> names;
  if (components == dimension) {
    names.assign(axis_names.begin(), axis_names.end());
  } else if (components == symmetric_components) {
    for (int k = 0; k < symmetric_components; ++k) names.push_back(symmetric_name(k));
  } else if (components > 1) {
    for (int i = 0; i < components; ++i) names.push_back(std::to_string(i + 1));
  }
  return names;
}

/// The names of components in the frame of a fracture cell: n, t of a vector (n, t1, t2 in three dimensions).
inline std::vector<std::string> component_names_on_fractures(int components) {
  if (components != dimension) return component_names(components);
  if (dimension == 2) return {"n", "t"};
  return {"n", "t1", "t2"};
}

}  // namespace sprekk
