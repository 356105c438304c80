// The commands and options that the command line declares. The manual page and completions are made from them.
#pragma once

#include <string>
#include <vector>

namespace CLI {
class App;
}

namespace sprekk {

/// An option or argument of a command as its parser declares it; completions and the manual page are made from it.
struct DeclaredOption {
  std::vector<std::string> names;  ///< "-o", "--output"; none for an argument that is known by its place
  std::string value;               ///< what it takes, "FOLDER" or "scene|study"; empty for a flag
  std::string description;
  bool is_list = false;  ///< whether it takes several values
  bool is_value_optional = false;
  bool is_repeated = false;  ///< whether it may be given several times

  bool is_positional() const { return names.empty(); }
  bool is_help() const { return !names.empty() && names.back() == "--help"; }
  /// "scene" and "study" of "scene|study"; nothing for other values.
  std::vector<std::string> choices() const;
};

/// A command with its options; the program itself is a command that has commands.
struct DeclaredCommand {
  std::string name, description;
  std::vector<DeclaredOption> options;
  std::vector<DeclaredCommand> commands;  ///< of the program; other commands have none
};

/// The declaration of a parser.
DeclaredCommand declared_command(const CLI::App& app);

}  // namespace sprekk
