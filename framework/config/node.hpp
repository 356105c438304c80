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

/// One `--set a.b.c=value`; the value is parsed as YAML. An item of a list is named by its index: `couplers.0.type`.
struct Override {
  std::string path;
  std::string value;
  Origin key_origin = {"--set"}, value_origin = {"--set"};  ///< a study's overrides stand in its file
};

/// Reads and merges scene files (later files win, maps merge key by key, lists and scalars replace, a null removes the
/// key: the rules of RFC 7386) and applies the overrides by the same rules.
/// Throws InputError for unreadable, binary, malformed or oversized input and for duplicate keys.
Node load_scene(const std::vector<std::string>& files, const std::vector<Override>& overrides);

/// Parses one YAML text, for tests and generated scenes. Anchors, aliases and merge keys (`<<`) are expanded;
/// at most 200,000 values, 64 levels deep, and 64 MiB, so that no small file can fill the memory.
Node parse_yaml(const std::string& text, const std::string& source_name);

}  // namespace sprekk
