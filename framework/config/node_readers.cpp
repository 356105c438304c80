// Reads keys, numbers and texts of nodes, with the messages for mistakes.
#include "framework/config/data_reader.hpp"

#include <algorithm>

#include "framework/config/units.hpp"

namespace sprekk {
namespace {

std::string found(const Node& node) {
  if (node.is_null()) return "nothing";
  if (node.is_scalar()) return quoted(node.scalar);
  return node.is_list() ? "a list" : "a map";
}

}  // namespace

InputError wrong_kind(const Node& node, const std::string& name, const std::string& needed) {
  if (node.is_null()) return InputError(node.origin, quoted(name) + " has no value", "needed is " + needed);
  return InputError(node.origin, quoted(name) + " is " + found(node), "needed is " + needed);
}

void require_known_keys(const Node& map, const std::vector<std::string>& allowed, const DataRequest& request) {
  for (const Node::Entry& entry : map.entries) {
    if (std::find(allowed.begin(), allowed.end(), entry.key) == allowed.end()) {
      throw unknown_name(entry.origin, "key of " + quoted(request.name) + ":", entry.key, allowed);
    }
  }
}

const Node& required_entry(const Node& map, const std::string& key, const DataRequest& request) {
  if (const Node* value = map.find(key)) return *value;
  throw InputError(map.origin, quoted(key) + " is missing for " + quoted(request.name),
                   "the map has: " + listed(map.keys()));
}

const std::string& read_scalar(const Node& node, const std::string& name) {
  if (!node.is_scalar()) throw wrong_kind(node, name, "one value");
  return node.scalar;
}

double read_number(const Node& node, const std::string& unit, const Range& range, const std::string& name) {
  if (!node.is_scalar()) throw wrong_kind(node, name, unit.empty() ? "one number" : "one number, in " + unit);
  const double value = parse_quantity(node.scalar, unit, node.origin, name);
  if (range.contains(value)) return value;
  throw InputError(node.origin, quoted(name) + " is " + quoted(node.scalar) + ", out of range",
                   "it must be " + range.text() + (unit.empty() ? "" : " " + unit));
}

}  // namespace sprekk
