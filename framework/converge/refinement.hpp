// What of a scene can be refined.
#pragma once

#include <string>
#include <utility>
#include <vector>

#include "framework/scene/scene.hpp"

namespace sprekk {

/// Values of a scene that are refined together, such as all sizes of its mesh.
struct Refinement {
  /// A value of the scene, by its path: a number with a unit, or a list of counts.
  struct Value {
    std::string path, text;
    bool is_count = false;  ///< of cells: more of them are finer
    double most = 0;        ///< largest value that is allowed; 0 for none
  };
  std::string name;  ///< "mesh", "step", "increment", or the path of one value
  std::vector<Value> values;

  /// The settings at a factor of the scene's values: {path, value}.
  std::vector<std::pair<std::string, std::string>> at(double factor) const;
};

/// All that can be refined in a scene: its mesh, its step if there are several, and for fractures that grow the fine
/// level and the increment. `chosen`: their names, or paths of values; all if there are none. Throws InputError.
std::vector<Refinement> refinements(const Scene& scene, const std::vector<std::string>& chosen);

}  // namespace sprekk
