// Reads keys, numbers and texts of nodes, with the messages for mistakes.
#include "framework/config/data_reader.hpp"

#include <algorithm>

#include "framework/config/units.hpp"
#include "framework/config/unknown_key.hpp"

namespace sprekk {
namespace {

std::string found(const Node& node) {
  if (node.is_null()) return "nothing";
  if (node.is_scalar()) return quoted(node.scalar);
  return node.is_list() ? "a list" : "a map";
}

}  // namespace

InputError wrong_kind(const Node& node, const std::string& name, const std::string& needed,
                      const std::string& suggestion) {
  return InputError(node.origin, quoted(name) + (node.is_null() ? " has no value" : " is " + found(node)),
                    "needed is " + needed, suggestion);
}

void require_known_keys(const Node& map, const std::vector<std::string>& allowed, const DataRequest& request) {
  std::vector<std::string> problems;
  for (const Node::Entry& entry : map.entries)
    if (std::find(allowed.begin(), allowed.end(), entry.key) == allowed.end())
      problems.emplace_back(
          unknown_key(entry.origin, "key of " + quoted(request.name) + ":", entry.key, allowed).what());
  if (!problems.empty()) throw InputError(problems);
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
