// The fingerprint that tells whether a checkpoint belongs to a scene.
#pragma once

#include <string>

#include "framework/scene/scene.hpp"

namespace sprekk {

/// What identifies a scene for a restart: all of it except the end time, the output and the name; neither comments nor
/// the order of reading matter. 16 hexadecimal digits.
std::string scene_fingerprint(const Scene& scene);

}  // namespace sprekk
