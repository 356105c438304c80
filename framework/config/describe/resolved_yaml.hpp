// A scene as the program has read it, with the origin of every value.
#pragma once

#include <string>
#include <vector>

namespace sprekk {

/// A parameter as ReadContext::record receives it.
struct ResolvedValue {
  std::string path;    ///< "components.pore.permeability", "couplers.0.type"
  std::string value;   ///< YAML on one line
  std::string origin;  ///< "scene.yaml:3:4", "default"
};

/// The values as YAML that can be run again: nested by path in the order of first appearance, each value with its
/// origin as a comment. Names 0, 1, 2, … at one place make a list. Of two values with the same path the later one is
/// written.
std::string resolved_yaml(const std::vector<ResolvedValue>& values);

}  // namespace sprekk
