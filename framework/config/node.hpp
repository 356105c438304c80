// The scene as a tree in which every key and value knows where it was written.
#pragma once

#include <string>
#include <utility>
#include <vector>

#include "framework/config/input_error.hpp"

namespace sprekk {

/// A value of a scene with its origin: a scalar, a list, a map or nothing.
class Node {
 public:
  /// What the node is.
  enum class Kind { null, scalar, list, map };
  struct Entry;

  Kind kind = Kind::null;
  Origin origin;               ///< of the value
  std::string path;            ///< "components.pore.permeability", for messages and `--set`
  std::string scalar;          ///< the text of a scalar, unparsed
  std::vector<Node> items;     ///< of a list
  std::vector<Entry> entries;  ///< of a map, in the order in which they were written

  bool is_null() const { return kind == Kind::null; }
  bool is_scalar() const { return kind == Kind::scalar; }
  bool is_list() const { return kind == Kind::list; }
  bool is_map() const { return kind == Kind::map; }
  const Node* find(const std::string& key) const;  ///< the value of a key of a map, or nullptr
  std::vector<std::string> keys() const;
  std::string text() const;  ///< as YAML on one line: "[1 m, {a: b}]"
};

/// A key of a map with its value.
struct Node::Entry {
  std::string key;
  Origin origin;  ///< of the key
  Node value;
};

/// `text` as a YAML scalar: in double quotes where YAML would read it as something else.
std::string yaml_scalar(const std::string& text);

}  // namespace sprekk
