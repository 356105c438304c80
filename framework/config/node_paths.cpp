#include "framework/config/node_paths.hpp"

namespace sprekk {

void set_paths(Node& node, const std::string& path) {
  node.path = path;
  for (std::size_t i = 0; i < node.items.size(); ++i) set_paths(node.items[i], joined_path(path, std::to_string(i)));
  for (Node::Entry& entry : node.entries) set_paths(entry.value, joined_path(path, entry.key));
}

}  // namespace sprekk
