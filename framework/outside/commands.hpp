// The commands that start other programs. The user gives them; no file does.
#pragma once

#include <map>
#include <optional>
#include <string>
#include <vector>

#include "framework/config/input_error.hpp"

namespace sprekk {

/// Takes "NAME=COMMAND": the shell command that starts the program of the component NAME. Throws InputError for
/// anything else, and for a name that has another command.
void take_program(const std::string& setting, const Origin& where);

/// Takes the settings of the variable SPREKK_PROGRAMS, one a line. Those for components that a scene has not are for
/// other scenes.
void take_programs_of_environment();

/// The command of a component; none where the user has given none.
std::optional<std::string> program_command(const std::string& component);
std::vector<std::string> programs_named();  ///< components with a command of this call

/// Variables of the environment with which another process knows these commands.
std::map<std::string, std::string> program_environment();

}  // namespace sprekk
