// What `--set path=value` says.
#pragma once

#include <string>
#include <vector>

#include "framework/config/yaml/load_scene.hpp"

namespace sprekk {

/// The overrides of settings "path=value". Throws InputError for a setting without a path or without '='.
std::vector<Override> overrides_of(const std::vector<std::string>& settings);

}  // namespace sprekk
