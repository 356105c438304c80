#include "framework/config/yaml/settings.hpp"

#include "framework/config/input_error.hpp"

namespace sprekk {

std::vector<Override> overrides_of(const std::vector<std::string>& settings) {
  std::vector<Override> overrides;
  for (const std::string& setting : settings) {
    const std::size_t equals = setting.find('=');
    if (equals == std::string::npos || equals == 0)
      throw InputError({"--set"}, "'" + setting + "' sets nothing", "a setting is a path, '=' and a value",
                       "write for example --set time.end='2 h'");
    const std::string path = setting.substr(0, equals);
    overrides.push_back({path, setting.substr(equals + 1), {"--set"}, {"--set " + path}});
  }
  return overrides;
}

}  // namespace sprekk
