#include "framework/module/module.hpp"

#include <dlfcn.h>

#include <map>
#include <stdexcept>
#include <string>

#include "framework/module/define_module.hpp"

namespace sprekk {
namespace {

const void* opened(const std::string& name) {
  const std::string file = "sprekk_" + name + ".so";
  const auto failed = [&](const std::string& why) {
    // The loader's messages when it finds no memory for a library.
    for (const char* lack : {"failed to map segment", "annot allocate memory"})
      if (why.find(lack) != std::string::npos)
        return std::runtime_error("there is not enough memory to open the module " + file + " (" + why +
                                  ") raise the limit of the memory (ulimit -v)");
    return std::runtime_error("cannot open the module " + file + " (" + why +
                              ") build or install Sprekk anew: the folder lib/sprekk belongs to the program");
  };
  const auto last_error = [&] {
    const char* const text = dlerror();
    std::string reason = text == nullptr ? "no reason is known" : text;
    if (reason.rfind(file + ": ", 0) == 0) reason.erase(0, file.size() + 2);
    return reason;
  };
  // A name without a folder: the system looks where the program says (its run path), relative to the program's file.
  void* const handle = dlopen(file.c_str(), RTLD_LAZY | RTLD_LOCAL);
  if (handle == nullptr) throw failed(last_error());
  const auto describe = reinterpret_cast<const ModuleDescription* (*)()>(dlsym(handle, SPREKK_MODULE_ENTRY));
  if (describe == nullptr) throw failed(last_error());
  const ModuleDescription& module = *describe();
  if (std::string(module.version) != SPREKK_VERSION)
    throw failed("it is of version " + std::string(module.version) + ", the program of " + SPREKK_VERSION);
  return module.interface;
}

}  // namespace

const void* open_module(const char* name) {
  static std::map<std::string, const void*> interfaces;
  const auto known = interfaces.find(name);
  if (known != interfaces.end()) return known->second;
  return interfaces.emplace(name, opened(name)).first->second;
}

}  // namespace sprekk
