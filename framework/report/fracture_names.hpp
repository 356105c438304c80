// What fractures are called in the scene of a run.
#pragma once

#include <string>
#include <vector>

namespace sprekk {

/// The names of fractures in `record` (run.json), when there are `count` of them; else "fracture 1", "fracture 2", …
std::vector<std::string> fracture_names(const std::string& record, std::size_t count);

}  // namespace sprekk
