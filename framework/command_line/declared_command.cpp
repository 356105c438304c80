#include "framework/command_line/declared_command.hpp"

#include <CLI/CLI.hpp>
#include <algorithm>
#include <sstream>

namespace sprekk {
namespace {

/// CLI11 writes the choices of a text as "TEXT:{scene,study}".
std::string readable(std::string type) {
  const std::size_t open = type.find('{'), close = type.find('}');
  if (open == std::string::npos || close == std::string::npos) return type.substr(0, type.find(':'));
  type = type.substr(open + 1, close - open - 1);
  std::replace(type.begin(), type.end(), ',', '|');
  return type;
}

}  // namespace

std::vector<std::string> DeclaredOption::choices() const {
  std::vector<std::string> all;
  if (value.find('|') == std::string::npos) return all;
  std::istringstream stream(value);
  for (std::string choice; std::getline(stream, choice, '|');) all.push_back(choice);
  return all;
}

DeclaredCommand declared_command(const CLI::App& app) {
  DeclaredCommand command{app.get_name(), app.get_description(), {}, {}};
  for (const CLI::Option* option : app.get_options()) {
    DeclaredOption declared;
    for (const std::string& name : option->get_snames()) declared.names.push_back("-" + name);
    for (const std::string& name : option->get_lnames()) declared.names.push_back("--" + name);
    const bool takes_value = option->get_items_expected_max() > 0;
    if (takes_value) declared.value = readable(option->get_type_name());
    declared.description = option->get_description();
    declared.is_list = declared.is_positional() && option->get_items_expected_max() > 1;
    declared.is_repeated = !declared.is_positional() && option->get_expected_max() > 1;
    declared.is_value_optional = takes_value && option->get_items_expected_min() == 0;
    command.options.push_back(std::move(declared));
  }
  for (const CLI::App* inner : app.get_subcommands([](const CLI::App*) { return true; }))
    command.commands.push_back(declared_command(*inner));
  return command;
}

}  // namespace sprekk
