// Modules: parts of the program that are opened when a run needs them, so that they do not slow the start of others.
#pragma once

namespace sprekk {

/// The interface of the module `name`, from its file sprekk_<name>.so, which is opened at the first call and stays
/// open. The files are beside the program that was built, or in lib/sprekk of an installation. Throws
/// std::runtime_error, with the reason, if the file is missing, damaged or of another version of Sprekk.
const void* open_module(const char* name);

/// The same as the abstract class `Interface` that the module implements.
template <class Interface>
const Interface& module(const char* name) {
  return *static_cast<const Interface*>(open_module(name));
}

}  // namespace sprekk
