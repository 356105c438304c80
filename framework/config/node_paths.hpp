// Paths of nodes: "components.pore.permeability", "couplers.0.type".
#pragma once

#include <string>

#include "framework/config/node.hpp"

namespace sprekk {

/// The path of what is called `name` in the node at `path`.
inline std::string joined_path(const std::string& path, const std::string& name) {
  return path.empty() ? name : path + "." + name;
}

/// "in 'a.b'", or "in the scene" at its top.
inline std::string in_path(const std::string& path) { return path.empty() ? "in the scene" : "in " + quoted(path); }

/// Gives the node and all below it their paths.
inline void set_paths(Node& node, const std::string& path) {
  node.path = path;
  for (std::size_t i = 0; i < node.items.size(); ++i) set_paths(node.items[i], joined_path(path, std::to_string(i)));
  for (Node::Entry& entry : node.entries) set_paths(entry.value, joined_path(path, entry.key));
}

}  // namespace sprekk
