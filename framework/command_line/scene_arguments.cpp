#include "framework/command_line/scene_arguments.hpp"

#include <filesystem>

#include "framework/config/yaml/load_scene.hpp"
#include "framework/config/yaml/settings.hpp"

namespace sprekk {

void SceneArguments::add_to(CLI::App& command) {
  command.add_option("scene", files, "Scene files; later ones win over earlier ones")->required()->type_name("SCENE");
  command.add_option("--set", settings, "Sets one value of the scene: --set time.end='2 h'; once for each value")
      ->allow_extra_args(false)
      ->type_name("PATH=VALUE");
}

Node SceneArguments::load() const {
  const std::vector<Override> overrides = overrides_of(settings);
  for (const std::string& file : files)
    if (file.find('=') != std::string::npos && !std::filesystem::exists(file))
      throw InputError({"sprekk"}, "there is no scene file '" + file + "'", "it looks like a setting",
                       "write --set before each setting");
  return load_scene(files, overrides);
}

std::string SceneArguments::folder() const {
  const std::string folder = std::filesystem::path(files.front()).parent_path().string();
  return folder.empty() ? "." : folder;
}

Scene SceneArguments::read() const {
  return read_scene(load(), folder(), std::filesystem::path(files.front()).stem().string());
}

}  // namespace sprekk
