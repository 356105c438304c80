// A scene as it was understood, with the origin of every value.
#pragma once

#include <string>
#include <vector>

namespace sprekk {

/// What ReadContext::record has been told.
struct ResolvedValue {
  std::string path;    ///< "components.pore.permeability", "couplers.0.type"
  std::string value;   ///< YAML on one line
  std::string origin;  ///< "scene.yaml:3:4", "default"
};

/// YAML, nested by path in the order of first appearance, each value with its origin as a comment: a scene that can be
/// run again. Where all names at a place are 0, 1, 2, … it is a list. Of two values with the same path the later stays.
std::string resolved_yaml(const std::vector<ResolvedValue>& values);

}  // namespace sprekk
