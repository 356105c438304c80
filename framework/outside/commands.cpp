#include "framework/outside/commands.hpp"

#include <cstdlib>
#include <sstream>

namespace sprekk {

namespace {

constexpr const char* programs_variable = "SPREKK_PROGRAMS";

/// A command, and whether an option has given it.
struct Command {
  std::string text;
  bool is_of_call;
};

std::map<std::string, Command>& commands() {
  static std::map<std::string, Command> commands;
  return commands;
}

void take(const std::string& setting, const Origin& where, bool is_of_call) {
  const std::size_t equals = setting.find('=');
  const std::string name = setting.substr(0, equals);
  const std::string command = equals == std::string::npos ? "" : setting.substr(equals + 1);
  if (name.empty() || command.find_first_not_of(' ') == std::string::npos)
    throw InputError(where, quoted(setting) + " starts no program", "it is the name of a component and a command",
                     "write for example 'model=python3 model.py'");
  if (command.find('\n') != std::string::npos)
    throw InputError(where, "the command of " + quoted(name) + " has several lines", "it is one line of a shell",
                     "put the lines into a file");
  const auto [place, is_new] = commands().try_emplace(name, Command{command, is_of_call});
  if (!is_new && place->second.text != command)
    throw InputError(where, quoted(name) + " has two commands", place->second.text + " is the other one", "remove one");
}

}  // namespace

void take_program(const std::string& setting, const Origin& where) { take(setting, where, true); }

void take_programs_of_environment() {
  const char* value = std::getenv(programs_variable);
  std::istringstream lines(value ? value : "");
  for (std::string line; std::getline(lines, line);)
    if (!line.empty() && commands().count(line.substr(0, line.find('='))) == 0) take(line, {programs_variable}, false);
}

std::optional<std::string> program_command(const std::string& component) {
  const auto found = commands().find(component);
  return found == commands().end() ? std::nullopt : std::optional(found->second.text);
}

std::vector<std::string> programs_named() {
  std::vector<std::string> names;
  for (const auto& [name, command] : commands())
    if (command.is_of_call) names.push_back(name);
  return names;
}

std::map<std::string, std::string> program_environment() {
  if (commands().empty()) return {};
  std::string lines;
  for (const auto& [name, command] : commands()) lines += name + "=" + command.text + "\n";
  return {{programs_variable, lines}};
}

}  // namespace sprekk
