// Compares the parameters of a scene with those in the record of a run.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "framework/output/run_record.hpp"

namespace sprekk {

/// Describes the first difference between the parameters `now` and those in `run_json`: "materials.friction was 0.5 and
/// is 0.6". Parameters that only `now` has count, and then those that only `run_json` has. Parameters under `output`,
/// `name` and `time.end` do not count. Empty when there is no difference or no readable record.
std::string parameter_difference(const std::filesystem::path& run_json, const std::vector<RunRecord::Parameter>& now);

}  // namespace sprekk
