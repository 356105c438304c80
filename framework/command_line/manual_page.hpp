// The manual page, from the same declaration of commands and options as --help.
#pragma once

#include <string>

#include "framework/command_line/declared_command.hpp"

namespace sprekk {

/// The text of sprekk.1, in the macros of man. `summary`: what the program is, in one line.
std::string manual_page(const DeclaredCommand& program, const std::string& summary, const std::string& version);

}  // namespace sprekk
