#include "framework/config/yaml/yaml_builder.hpp"

#include <algorithm>

namespace sprekk {
namespace {

constexpr int most_nodes = 200'000;  // no scene is larger, and a file from a stranger may be
constexpr int greatest_depth = 64;   // the same, for the stack

int size_of(const Node& node) {
  int size = 1;
  for (const Node& item : node.items) size += size_of(item);
  for (const Node::Entry& entry : node.entries) size += size_of(entry.value);
  return size;
}

int depth_of(const Node& node) {
  int depth = 0;
  for (const Node& item : node.items) depth = std::max(depth, depth_of(item));
  for (const Node::Entry& entry : node.entries) depth = std::max(depth, depth_of(entry.value));
  return depth + 1;
}

/// Refuses what looks like a space or like nothing, and is neither: it comes with text that is copied from a page.
void require_plain_spaces(const std::string& text, const Origin& where) {
  for (const auto& [character, name] :
       {std::pair("\u00A0", "non-breaking space"), std::pair("\u202F", "narrow non-breaking space"),
        std::pair("\u2007", "figure space"), std::pair("\u2009", "thin space"),
        std::pair("\u200B", "space of no width"), std::pair("\uFEFF", "byte order mark")}) {
    const std::size_t at = text.find(character);
    if (at != std::string::npos)
      throw InputError(
          where, quoted(text) + " has a " + name,
          "behind its character " + std::to_string(at) + "; it looks like a space, and is another character",
          "type a space instead");
  }
}

/// Takes over the entries of `from` that `map` does not have itself.
void merge_missing(Node& map, const Node& from) {
  if (!from.is_map()) throw InputError(from.origin, "'<<' needs a map to merge", "this is not one");
  for (const Node::Entry& entry : from.entries) {
    if (map.find(entry.key) == nullptr) map.entries.push_back(entry);
  }
}

/// Applies YAML's merge key, `<<: *base` or a list of such; of a list the first entry with a key wins.
void expand_merge_key(Node& map) {
  const auto is_merge = [](const Node::Entry& entry) { return entry.key == "<<"; };
  const auto merge = std::find_if(map.entries.begin(), map.entries.end(), is_merge);
  if (merge == map.entries.end()) return;
  const Node from = std::move(merge->value);
  map.entries.erase(merge);
  if (!from.is_list()) return merge_missing(map, from);
  for (const Node& item : from.items) merge_missing(map, item);
}

}  // namespace

void YamlBuilder::OnDocumentStart(const YAML::Mark& mark) { root_.origin = origin(mark); }

void YamlBuilder::OnNull(const YAML::Mark& mark, YAML::anchor_t anchor) {
  Node node;
  node.origin = origin(mark);
  count(1, node.origin);
  remember(node, anchor);
  add(std::move(node));
}

void YamlBuilder::OnAlias(const YAML::Mark& mark, YAML::anchor_t anchor) {
  const auto found = anchored_.find(anchor);
  if (found == anchored_.end()) {
    throw InputError(origin(mark), "an alias stands inside the value that it repeats", "the value would never end");
  }
  count(found->second.size, origin(mark));
  require_depth(static_cast<int>(open_.size()) + found->second.depth, origin(mark));
  add(found->second.node);
}

void YamlBuilder::OnScalar(const YAML::Mark& mark, const std::string& tag, YAML::anchor_t anchor,
                           const std::string& value) {
  Node node;
  node.kind = Node::Kind::scalar;
  node.origin = origin(mark);
  node.scalar = value;
  require_no_tag(tag, node.origin);
  require_plain_spaces(value, node.origin);
  count(1, node.origin);
  remember(node, anchor);
  add(std::move(node));
}

void YamlBuilder::OnSequenceStart(const YAML::Mark& mark, const std::string& tag, YAML::anchor_t anchor,
                                  YAML::EmitterStyle::value) {
  open(Node::Kind::list, mark, tag, anchor);
}

void YamlBuilder::OnMapStart(const YAML::Mark& mark, const std::string& tag, YAML::anchor_t anchor,
                             YAML::EmitterStyle::value) {
  open(Node::Kind::map, mark, tag, anchor);
}

void YamlBuilder::count(int nodes, const Origin& where) {
  count_ += nodes;
  if (count_ > most_nodes) {
    throw InputError(where, "the scene is too large",
                     "it has more than " + std::to_string(most_nodes) + " values once aliases are expanded",
                     "put long tables into CSV files");
  }
}

void YamlBuilder::require_depth(int depth, const Origin& where) const {
  if (depth > greatest_depth) {
    throw InputError(where, "the scene is nested too deeply", "at most " + std::to_string(greatest_depth) + " levels");
  }
}

void YamlBuilder::require_no_tag(const std::string& tag, const Origin& where) const {
  if (tag.empty() || tag == "?" || tag == "!") return;  // what the parser says of plain and quoted values
  throw InputError(where, "unexpected YAML tag " + quoted(tag), "scenes have no tags", "write the value alone");
}

void YamlBuilder::open(Node::Kind kind, const YAML::Mark& mark, const std::string& tag, YAML::anchor_t anchor) {
  const Origin where = origin(mark);
  require_no_tag(tag, where);
  count(1, where);
  require_depth(static_cast<int>(open_.size()) + 1, where);
  Open opened;
  opened.node.kind = kind;
  opened.node.origin = where;
  opened.anchor = anchor;
  open_.push_back(std::move(opened));
}

void YamlBuilder::close() {
  Open closed = std::move(open_.back());
  open_.pop_back();
  if (closed.node.is_map()) expand_merge_key(closed.node);
  remember(closed.node, closed.anchor);
  add(std::move(closed.node));
}

void YamlBuilder::remember(const Node& node, YAML::anchor_t anchor) {
  if (anchor == 0) return;
  const int size = size_of(node);
  count(size, node.origin);  // the copy kept here takes memory as well: anchors inside anchors would multiply
  anchored_[anchor] = {node, size, depth_of(node)};
}

void YamlBuilder::add(Node node) {
  if (open_.empty()) {
    root_ = std::move(node);
    return;
  }
  Open& parent = open_.back();
  if (parent.node.is_list()) {
    parent.node.items.push_back(std::move(node));
  } else if (!parent.has_key) {
    take_key(parent, node);
  } else {
    if (node.is_null()) node.origin = parent.key_origin;  // the parser places an empty value at the next key
    parent.node.entries.push_back({parent.key, parent.key_origin, std::move(node)});
    parent.has_key = false;
  }
}

void YamlBuilder::take_key(Open& map, const Node& key) {
  if (!key.is_scalar() || key.scalar.empty()) {
    throw InputError(key.origin, "a key of a map must be a name", "this one is empty or a list or a map");
  }
  const auto [first, is_new] = map.keys.emplace(key.scalar, key.origin);
  if (!is_new) {
    throw InputError(key.origin, "duplicate key " + quoted(key.scalar), "it stands already at " + first->second.text(),
                     "keep one of them");
  }
  map.has_key = true;
  map.key = key.scalar;
  map.key_origin = key.origin;
}

}  // namespace sprekk
