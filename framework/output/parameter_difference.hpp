// What has changed in a scene since a run wrote its record.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "framework/output/run_record.hpp"

namespace sprekk {

/// The first of `now` (in their order) whose value differs from the one in `run_json`, or that is not there, or else
/// the first one there that is not in `now`: "materials.friction was 0.5 and is 0.6". Parameters under `output`,
/// `name` and `time.end` do not count. Empty when there is no difference or no readable record.
std::string parameter_difference(const std::filesystem::path& run_json, const std::vector<RunRecord::Parameter>& now);

}  // namespace sprekk
