// Plug-ins: shared libraries that register further types of components and couplers when they are loaded.
#pragma once

#include <filesystem>
#include <map>
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

/// Loads a plug-in that the user has named: by an option, or in SPREKK_PLUGINS. Throws as load_plugin.
void load_plugin_of_user(const std::filesystem::path& file, const Origin& where);

/// Plug-ins in this folder, and below it, may be opened because a scene names them. Throws InputError at `where` if
/// there is no such folder.
void trust_plugins_in(const std::filesystem::path& folder, const Origin& where);

/// Loads the plug-ins that the variable SPREKK_PLUGINS lists, and trusts the folders of SPREKK_PLUGIN_FOLDERS; both
/// separated by ':'.
void take_plugins_of_environment();

/// Loads a plug-in that a scene names. A plug-in is a program, and a scene may come from anybody: throws InputError at
/// `where`, and opens nothing, unless the file stands in a trusted folder (symbolic links are followed first), or the
/// user has named it.
void load_plugin_of_scene(const std::filesystem::path& file, const Origin& where);

/// Variables of the environment with which another process loads and trusts what this one does.
std::map<std::string, std::string> plugin_environment();

/// For registries: tells that a type has been registered.
void note_registration(const std::string& type);
/// For registries: tells that a type exists already. It is refused when the plug-in has been loaded; outside of
/// plug-ins it is a std::logic_error.
void refuse_registration(const std::string& type);

}  // namespace sprekk
