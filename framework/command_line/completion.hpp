// Scripts by which a shell completes commands, from the same declaration of commands and options as --help.
#pragma once

#include <string>

#include "framework/command_line/declared_command.hpp"

namespace sprekk {

/// A script for bash; it defines the function _sprekk.
std::string bash_completion(const DeclaredCommand& program);
/// A script for zsh, to be found as _sprekk in its search path.
std::string zsh_completion(const DeclaredCommand& program);

}  // namespace sprekk
