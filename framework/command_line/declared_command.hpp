// The commands and options that the command line declares, for what is written about them: the manual page and
// completions.
#pragma once

#include <string>
#include <vector>

namespace CLI {
class App;
}

namespace sprekk {

/// An option or argument of a command as its parser declares it; completions and the manual page are made from it.
struct DeclaredOption {
  std::vector<std::string> names;  ///< "-o", "--output"; none for what is told by its place
  std::string value;               ///< what it takes, "FOLDER" or "scene|study"; empty for a flag
  std::string description;
  bool is_list = false;  ///< takes several values
  bool is_value_optional = false;
  bool is_repeated = false;  ///< may stand several times

  bool is_positional() const { return names.empty(); }
  bool is_help() const { return !names.empty() && names.back() == "--help"; }
  /// "scene" and "study" of "scene|study"; nothing for other values.
  std::vector<std::string> choices() const;
};

/// A command with its options, and for the program itself its commands.
struct DeclaredCommand {
  std::string name, description;
  std::vector<DeclaredOption> options;
  std::vector<DeclaredCommand> commands;  ///< those of the program
};

/// Reads back what a parser declares.
DeclaredCommand declared_command(const CLI::App& app);

}  // namespace sprekk
