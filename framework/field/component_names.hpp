// What the components of vectors and tensors are called.
#pragma once

#include <string>
#include <vector>

#include "framework/types.hpp"

namespace sprekk {

/// Of a field in the coordinates of the scene, by the number of its components: x, y of a vector, xx, yy, xy of a
/// symmetric tensor (the diagonal first), 1, 2, … of others; none of a scalar.
inline std::vector<std::string> component_names(int components) {
  static const char* const axes[] = {"x", "y", "z"};
  std::vector<std::string> names;
  if (components == dimension) {
    for (int i = 0; i < dimension; ++i) names.emplace_back(axes[i]);
  } else if (components == symmetric_components) {
    for (int i = 0; i < dimension; ++i) names.push_back(std::string(axes[i]) + axes[i]);
    for (int i = 0; i < dimension; ++i)
      for (int k = i + 1; k < dimension; ++k) names.push_back(std::string(axes[i]) + axes[k]);
  } else if (components > 1) {
    for (int i = 0; i < components; ++i) names.push_back(std::to_string(i + 1));
  }
  return names;
}

/// The same on fractures, in the frame of their cells: n, t of a pair.
inline std::vector<std::string> component_names_on_fractures(int components) {
  if (components == 2) return {"n", "t"};
  return component_names(components);
}

}  // namespace sprekk
