// Reads scene files, and merges them and the overrides of the command line into one tree.
#pragma once

#include <string>
#include <vector>

#include "framework/config/node.hpp"

namespace sprekk {

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

}  // namespace sprekk
