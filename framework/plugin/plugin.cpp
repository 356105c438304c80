#include "framework/plugin/plugin.hpp"

#include <cxxabi.h>
#include <dlfcn.h>

#include <algorithm>
#include <cstdlib>
#include <memory>
#include <optional>
#include <sstream>
#include <stdexcept>

#include "framework/plugin/interface_name.hpp"
#include "framework/types.hpp"

extern "C" {
extern __attribute__((visibility("default"))) const char SPREKK_INTERFACE;
const char SPREKK_INTERFACE = 0;
}

namespace sprekk {

namespace {

/// What the plug-in that is being loaded has done so far.
struct Loading {
  Plugin plugin;
  std::vector<std::string> refused;
};

std::vector<Plugin>& plugins() {
  static std::vector<Plugin> loaded;
  return loaded;
}

std::optional<Loading>& loading() {
  static std::optional<Loading> now;
  return now;
}

std::string readable(const std::string& symbol) {
  int status = 0;
  const std::unique_ptr<char, decltype(&std::free)> text(abi::__cxa_demangle(symbol.c_str(), nullptr, nullptr, &status),
                                                         &std::free);
  return status == 0 ? text.get() : symbol;
}

/// The loader's message, as an error with a suggestion.
InputError refused(const std::filesystem::path& file, const std::string& said, const Origin& where) {
  const std::string what = "plug-in '" + file.string() + "' cannot be loaded";
  const std::string lead = "undefined symbol: ", interface = "sprekk_interface_";
  const std::size_t at = said.find(lead);
  if (at == std::string::npos)
    return InputError(where, what, said, "build it by sprekk_plugin() of Sprekk's CMake package");
  std::string symbol = said.substr(at + lead.size());
  symbol = symbol.substr(0, symbol.find_first_of(" ,\n\t"));
  if (symbol.rfind(interface, 0) == 0) {
    const std::string own = SPREKK_TEXT(SPREKK_INTERFACE);
    const std::string of_plane = "_2d", of_space = "_3d", &other = dimension == 2 ? of_space : of_plane;
    if (symbol == own.substr(0, own.size() - other.size()) + other)
      return InputError(where, what,
                        dimension == 2 ? "it is for scenes in space, and this is none"
                                       : "it is for scenes in a plane, and this one is in space",
                        "build it with -D sprekk_DIMENSION=" + std::to_string(dimension));
    return InputError(where, what,
                      "it was built for the interface " + symbol.substr(interface.size()) + ", and this program has " +
                          own.substr(interface.size()) + ": version, headers or alignment differ",
                      "build it anew, with the headers of this program and its compiler options");
  }
  return InputError(where, what, "it uses " + quoted(readable(symbol)) + ", which this program does not have",
                    "add the source that defines it to the plug-in, or build it anew for this program");
}

constexpr const char* plugins_variable = "SPREKK_PLUGINS";
constexpr const char* folders_variable = "SPREKK_PLUGIN_FOLDERS";

/// What the user, not a scene, has said: plug-ins that he or she has named, and folders that are trusted; whole paths.
struct WordOfUser {
  std::vector<std::filesystem::path> plugins, folders;
};

WordOfUser& word_of_user() {
  static WordOfUser word;
  return word;
}

/// The parts of a variable between ':', without empty ones.
std::vector<std::string> listed_in(const char* variable) {
  const char* const text = std::getenv(variable);
  std::istringstream whole(text == nullptr ? "" : text);
  std::vector<std::string> parts;
  for (std::string part; std::getline(whole, part, ':');)
    if (!part.empty()) parts.push_back(part);
  return parts;
}

bool is_inside(const std::filesystem::path& file, const std::filesystem::path& folder) {
  const std::filesystem::path way = file.lexically_relative(folder);
  return !way.empty() && *way.begin() != ".." && way != ".";
}

}  // namespace

const std::vector<Plugin>& loaded_plugins() { return plugins(); }

void note_registration(const std::string& type) {
  if (loading()) loading()->plugin.types.push_back(type);
}

void refuse_registration(const std::string& type) {
  if (!loading()) throw std::logic_error("type " + type + " is registered twice");
  loading()->refused.push_back(type);
}

void load_plugin(const std::filesystem::path& file, const Origin& where) {
  std::error_code failure;
  const std::filesystem::path place = std::filesystem::weakly_canonical(file, failure);
  if (failure || !std::filesystem::is_regular_file(place))
    throw InputError(where, "there is no plug-in '" + file.string() + "'",
                     "looked for at " + std::filesystem::absolute(file).lexically_normal().string(),
                     "build it, or correct the path");
  for (const Plugin& known : plugins())
    if (known.file == place) return;

  loading().emplace();
  loading()->plugin.file = place;
  // All symbols are looked up before any code of the plug-in runs.
  void* const handle = dlopen(place.c_str(), RTLD_NOW | RTLD_LOCAL);
  const std::string said = handle == nullptr ? dlerror() : "";
  const Loading done = std::move(*loading());
  loading().reset();
  if (handle == nullptr) throw refused(file, said, where);
  if (dlsym(handle, "sprekk_plugin") == nullptr)
    throw refused(file, "it is a library, but no plug-in of Sprekk", where);
  if (!done.refused.empty())
    throw InputError(where, "plug-in '" + file.string() + "' brings the type " + quoted(done.refused.front()),
                     "a type of this name exists", "give it a name of its own");
  plugins().push_back(done.plugin);
}

void load_plugin_of_user(const std::filesystem::path& file, const Origin& where) {
  load_plugin(file, where);
  word_of_user().plugins.push_back(std::filesystem::canonical(file));
}

void trust_plugins_in(const std::filesystem::path& folder, const Origin& where) {
  std::error_code failure;
  const std::filesystem::path place = std::filesystem::canonical(folder, failure);
  if (failure || !std::filesystem::is_directory(place))
    throw InputError(where, "there is no folder '" + folder.string() + "'", "plug-ins in it were to be trusted",
                     "correct the path");
  word_of_user().folders.push_back(place);
}

void take_plugins_of_environment() {
  for (const std::string& file : listed_in(plugins_variable)) load_plugin_of_user(file, {plugins_variable});
  for (const std::string& folder : listed_in(folders_variable)) trust_plugins_in(folder, {folders_variable});
}

void load_plugin_of_scene(const std::filesystem::path& file, const Origin& where) {
  std::error_code failure;
  const std::filesystem::path place = std::filesystem::weakly_canonical(file, failure);
  const bool is_trusted =
      std::ranges::any_of(plugins(), [&](const Plugin& known) { return known.file == place; }) ||
      std::ranges::any_of(word_of_user().folders, [&](const auto& folder) { return is_inside(place, folder); });
  if (std::filesystem::exists(place, failure) && !is_trusted)
    throw InputError(where, "the plug-in '" + file.string() + "' is in no folder that you trust",
                     "a plug-in is a program and may do all that you may; nothing of it was opened",
                     "if you know where it comes from, add '--plugins " + place.parent_path().string() + "', or set " +
                         folders_variable);
  load_plugin(file, where);
}

std::map<std::string, std::string> plugin_environment() {
  std::map<std::string, std::string> variables;
  const auto list = [&](const char* variable, const std::vector<std::filesystem::path>& paths) {
    for (const std::filesystem::path& path : paths) {
      std::string& text = variables[variable];
      text += (text.empty() ? "" : ":") + path.string();
    }
  };
  list(plugins_variable, word_of_user().plugins);
  list(folders_variable, word_of_user().folders);
  return variables;
}

}  // namespace sprekk
