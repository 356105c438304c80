// Identities of scenes, by which a study knows whether a run has been done already.
#pragma once

#include <filesystem>
#include <string>

#include "framework/config/node.hpp"

namespace sprekk {

/// 16 hexadecimal digits that change with every value of the scene and with the content of every file that it names
/// (relative to `folder`), but neither with comments, nor with the order of keys, nor with the scene's name.
std::string scene_identity(const Node& scene, const std::filesystem::path& folder);

/// The identity of a text.
std::string text_identity(const std::string& text);

}  // namespace sprekk
