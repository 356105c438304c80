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
  if (symbol.rfind(interface, 0) == 0)
    return InputError(where, what,
                      "it was built for the interface " + symbol.substr(interface.size()) + ", and this program has " +
                          std::string(SPREKK_TEXT(SPREKK_INTERFACE)).substr(interface.size()) +
                          ": version, headers or alignment differ",
                      "build it anew, with the headers of this program and its compiler options");
  return InputError(where, what, "it uses " + quoted(readable(symbol)) + ", which this program does not have",
                    "add the source that defines it to the plug-in, or build it anew for this program");
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

void load_plugins_of_environment() {
  const char* const listed = std::getenv("SPREKK_PLUGINS");
  if (listed == nullptr) return;
  std::istringstream files(listed);
  for (std::string file; std::getline(files, file, ':');)
    if (!file.empty()) load_plugin(file, {"SPREKK_PLUGINS"});
}

}  // namespace sprekk
