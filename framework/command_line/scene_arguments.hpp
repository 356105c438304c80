// The arguments that name a scene: files and overrides.
#pragma once

#include <CLI/CLI.hpp>
#include <string>
#include <vector>

#include "framework/scene/scene.hpp"

namespace sprekk {

/// The files of a scene and the settings that override their values.
struct SceneArguments {
  std::vector<std::string> files;
  std::vector<std::string> settings;  ///< "a.b=value"

  void add_to(CLI::App& command);
  /// The folder of the first file, to which the files that the scene names are relative.
  std::string folder() const;
  /// The scene as it is written, with the overrides. Throws InputError.
  Node load() const;
  /// Reads the scene. Throws InputError.
  Scene read() const;
};

}  // namespace sprekk
