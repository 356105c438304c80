// The manual page, from the same declaration of commands and options as --help.
#pragma once

#include <string>

#include "framework/command_line/declared_command.hpp"

namespace sprekk {

/// sprekk.1, in the man macros. `summary`: what the program is, in a line.
std::string manual_page(const DeclaredCommand& program, const std::string& summary, const std::string& version);

}  // namespace sprekk
