// Defines the function by which a module offers its interface. Included by one source of each module.
#pragma once

namespace sprekk {

/// The description of a module, returned by the one function that the module exports.
struct ModuleDescription {
  const char* version;    ///< of Sprekk, when the module was built
  const void* interface;  ///< to an object of the abstract class that the module implements
};

}  // namespace sprekk

#define SPREKK_MODULE_ENTRY "sprekk_module"

/// In a module: offers an object of `Implementation`, a class derived from `Interface` alone.
#define SPREKK_DEFINE_MODULE(Interface, Implementation)                                                \
  extern "C" __attribute__((visibility("default"))) const sprekk::ModuleDescription* sprekk_module() { \
    static const Implementation implementation;                                                        \
    static const Interface& interface = implementation;                                                \
    static const sprekk::ModuleDescription description{SPREKK_VERSION, &interface};                    \
    return &description;                                                                               \
  }
