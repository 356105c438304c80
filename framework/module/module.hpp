// Parts of the program that are opened when they are needed: what only some runs use would slow the start of each.
#pragma once

namespace sprekk {

/// What the module `name` offers, from its file sprekk_<name>.so. It is opened at the first call and stays open. The
/// files lie where the program was built or installed to look for them: beside it, in lib/sprekk. Throws
/// std::runtime_error, with the reason, if the file is missing, damaged or of another version of Sprekk.
const void* open_module(const char* name);

/// The same as the abstract class `Interface` that the module implements.
template <class Interface>
const Interface& module(const char* name) {
  return *static_cast<const Interface*>(open_module(name));
}

}  // namespace sprekk
