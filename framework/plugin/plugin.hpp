// Plug-ins: shared libraries that register further types of components and couplers when they are loaded.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "framework/config/node.hpp"

namespace sprekk {

/// A plug-in in use.
struct Plugin {
  std::filesystem::path file;
  std::vector<std::string> types;  ///< that it has registered
};

/// All plug-ins in use, in the order of loading.
const std::vector<Plugin>& loaded_plugins();

/// Loads a plug-in; one that is loaded already is not loaded again. Throws InputError at `where` for a file that is
/// missing, no plug-in, built for another interface of Sprekk, lacks a symbol, or registers a type that exists.
void load_plugin(const std::filesystem::path& file, const Origin& where);

/// Loads the plug-ins that the variable SPREKK_PLUGINS lists, separated by ':'.
void load_plugins_of_environment();

/// For registries: tells that a type has been registered.
void note_registration(const std::string& type);
/// For registries: tells that a type exists already. It is refused when the plug-in has been loaded; outside of
/// plug-ins it is a std::logic_error.
void refuse_registration(const std::string& type);

}  // namespace sprekk
