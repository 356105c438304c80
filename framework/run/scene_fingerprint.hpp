// The fingerprint that tells whether a checkpoint belongs to a scene.
#pragma once

#include <string>
#include <vector>

#include "framework/scene/scene.hpp"

namespace sprekk {

/// What identifies a scene for a restart: all of it except the end time, the output and the name, and the content of
/// the tables and of the mesh file that it names; neither comments nor the order of reading matter. 16 hexadecimal
/// digits.
std::string scene_fingerprint(const Scene& scene);

/// The tables and the mesh file that a scene names, as it writes them, each once.
std::vector<std::string> files_of(const Scene& scene);

}  // namespace sprekk
