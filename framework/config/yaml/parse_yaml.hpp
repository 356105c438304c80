// Reads a YAML text into a tree of nodes.
#pragma once

#include <string>

#include "framework/config/node.hpp"

namespace sprekk {

/// Parses one YAML text, for tests and generated scenes. Anchors, aliases and merge keys (`<<`) are expanded;
/// at most 200,000 values, 64 levels deep, and 64 MiB, so that no small file can fill the memory.
Node parse_yaml(const std::string& text, const std::string& source_name);

}  // namespace sprekk
