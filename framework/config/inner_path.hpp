// Paths of the maps inside of a map.
#pragma once

#include <string>

#include "framework/config/node_paths.hpp"
#include "framework/config/parameter.hpp"

namespace sprekk {

/// The path of the map that a section in the map at `path` reads: "output.probes.NAME".
inline std::string inner_path(const std::string& path, const Parameter& section) {
  const std::string item = section.kind == "section" ? "" : section.kind == "named sections" ? ".NAME" : ".INDEX";
  return joined_path(path, section.name) + item;
}

}  // namespace sprekk
