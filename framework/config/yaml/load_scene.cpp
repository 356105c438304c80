#include "framework/config/yaml/load_scene.hpp"

#include <algorithm>
#include <charconv>

#include "framework/config/node_paths.hpp"
#include "framework/config/text_file.hpp"
#include "framework/config/yaml/parse_yaml.hpp"

namespace sprekk {
namespace {

constexpr std::size_t longest_path = 64;  // keys: no scene is deeper (yaml_builder.cpp)

Node::Entry* entry_of(Node& map, const std::string& key) {
  for (Node::Entry& entry : map.entries) {
    if (entry.key == key) return &entry;
  }
  return nullptr;
}

/// Merges `later` over `base` by the rules of RFC 7386: null removes a key.
void merge(Node& base, Node later) {
  if (!base.is_map() || !later.is_map()) {
    base = std::move(later);
    return;
  }
  base.origin = later.origin;
  for (Node::Entry& entry : later.entries) {
    Node::Entry* existing = entry_of(base, entry.key);
    if (existing == nullptr) {
      base.entries.push_back(std::move(entry));
    } else if (entry.value.is_null()) {
      base.entries.erase(base.entries.begin() + (existing - base.entries.data()));
    } else {
      existing->origin = entry.origin;
      merge(existing->value, std::move(entry.value));
    }
  }
}

Node load_file(const std::string& file) {
  Node root = parse_yaml(read_text_file(file, file), file);
  if (!root.is_map() && !root.is_null()) {
    throw InputError(root.origin, "a scene is a map of keys", "this file holds a list or a single value",
                     "begin with 'components:' or another section");
  }
  return root;
}

void set_origins(Node& node, const Origin& origin) {
  node.origin = origin;
  for (Node& item : node.items) set_origins(item, origin);
  for (Node::Entry& entry : node.entries) {
    entry.origin = origin;
    set_origins(entry.value, origin);
  }
}

/// The origin for messages on the path of an override.
Origin place_of(const Override& change) {
  return change.key_origin.source == "--set" ? Origin{"--set " + change.path} : change.key_origin;
}

std::vector<std::string> split_path(const Override& change) {
  const Origin where = place_of(change);
  std::vector<std::string> parts{""};
  for (const char c : change.path) {
    if (c == '.') {
      parts.emplace_back();
    } else {
      parts.back() += c;
    }
  }
  if (std::find(parts.begin(), parts.end(), "") != parts.end()) {
    throw InputError(where, "empty name in the path " + quoted(change.path), "",
                     where.line > 0 ? "write section.key" : "write --set section.key=value");
  }
  if (parts.size() > longest_path) throw InputError(where, "the path is too long", "at most 64 names");
  return parts;
}

Node& item_of(Node& list, const std::string& index, const Override& change) {
  int i = -1;
  const auto [end, error] = std::from_chars(index.data(), index.data() + index.size(), i);
  const bool is_index = error == std::errc{} && end == index.data() + index.size();
  if (!is_index || i < 0 || i >= static_cast<int>(list.items.size())) {
    throw InputError(place_of(change), sprekk::quoted(list.path) + " has no item " + sprekk::quoted(index),
                     "it is a list of " + std::to_string(list.items.size()) + ", counted from 0");
  }
  return list.items[static_cast<std::size_t>(i)];
}

void apply(Node& root, const Override& change) {
  const std::vector<std::string> parts = split_path(change);
  Node value = parse_yaml(change.value, "--set " + change.path);
  set_origins(value, change.value_origin);
  Node* node = &root;
  for (std::size_t i = 0; i < parts.size(); ++i) {
    if (node->is_list()) {
      node = &item_of(*node, parts[i], change);
      continue;
    }
    if (node->is_scalar()) {
      throw InputError(place_of(change), sprekk::quoted(node->path) + " has no keys",
                       "it is the value " + sprekk::quoted(node->scalar) + ", from " + node->origin.text());
    }
    node->kind = Node::Kind::map;  // a node that was missing or empty becomes a map
    Node::Entry* entry = entry_of(*node, parts[i]);
    const bool removes = i + 1 == parts.size() && value.is_null();
    if (removes) {
      if (entry == nullptr) {
        throw InputError(place_of(change), "there is no " + quoted(change.path) + " to remove",
                         "an empty value removes a key", "give a value behind '='");
      }
      node->entries.erase(node->entries.begin() + (entry - node->entries.data()));
      return;
    }
    if (entry == nullptr) {
      Node created;
      created.origin = change.value_origin;
      created.path = joined_path(node->path, parts[i]);
      node->entries.push_back({parts[i], place_of(change), std::move(created)});
      entry = &node->entries.back();
    }
    node = &entry->value;
  }
  merge(*node, std::move(value));
  set_paths(root, "");
}

}  // namespace

Node load_scene(const std::vector<std::string>& files, const std::vector<Override>& overrides) {
  Node root;
  for (const std::string& file : files) {
    Node loaded = load_file(file);
    if (!loaded.is_null()) merge(root, std::move(loaded));
  }
  set_paths(root, "");
  for (const Override& change : overrides) apply(root, change);
  if (root.is_null()) {
    throw InputError({files.empty() ? "" : files.front()}, "the scene is empty", "",
                     "begin with 'components:' or another section");
  }
  return root;
}

}  // namespace sprekk
