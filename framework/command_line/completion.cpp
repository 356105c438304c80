#include "framework/command_line/completion.hpp"

namespace sprekk {
namespace {

std::string joined(const std::vector<std::string>& words, const std::string& separator) {
  std::string text;
  for (const std::string& word : words) text += (text.empty() ? "" : separator) + word;
  return text;
}

/// A line of bash that sets COMPREPLY to the words that may stand as the value of an option.
std::string bash_values(const DeclaredOption& option) {
  const std::vector<std::string> choices = option.choices();
  if (!choices.empty()) return "COMPREPLY=($(compgen -W '" + joined(choices, " ") + "' -- \"$word\"))";
  if (option.value == "SCENE" || option.value == "STUDY") return "_sprekk_files yaml";
  if (option.value == "CHECKPOINT") return "_sprekk_files h5";
  if (option.value == "PICTURE") return "_sprekk_files 'dot|svg'";
  if (option.value == "FOLDER") return "_sprekk_files ''";
  if (option.value == "NAME") return "COMPREPLY=($(compgen -W \"$(_sprekk_names)\" -- \"$word\"))";
  return ":";
}

std::string bash_case(const DeclaredCommand& command) {
  std::vector<std::string> words;
  std::string values, positional = ":";
  for (const DeclaredOption& option : command.options) {
    words.insert(words.end(), option.names.begin(), option.names.end());
    if (option.is_positional()) positional = bash_values(option);
    if (!option.is_positional() && !option.value.empty())
      values += "        " + joined(option.names, " | ") + ") " + bash_values(option) + "; return ;;\n";
  }
  return "    " + command.name + ")\n" + (values.empty() ? "" : "      case $before in\n" + values + "      esac\n") +
         "      if [[ $word == -* ]]; then COMPREPLY=($(compgen -W '" + joined(words, " ") + "' -- \"$word\")); else " +
         positional + "; fi ;;\n";
}

std::string zsh_quoted(const std::string& text) {
  std::string result;
  for (const char c : text) {
    if (c == '\'') {
      result += "'\\''";
    } else {
      if (c == '[' || c == ']' || c == ':' || c == '\\') result += '\\';
      result += c;
    }
  }
  return result;
}

std::string zsh_values(const DeclaredOption& option) {
  const std::vector<std::string> choices = option.choices();
  if (!choices.empty()) return "(" + joined(choices, " ") + ")";
  if (option.value == "SCENE" || option.value == "STUDY") return "_files -g \"*.yaml\"";
  if (option.value == "CHECKPOINT") return "_files -g \"*.h5\"";
  if (option.value == "PICTURE") return "_files -g \"*.(dot|svg)\"";
  if (option.value == "FOLDER") return "_files -/";
  if (option.value == "NAME") return "_sprekk_names";
  return " ";
}

std::string zsh_arguments(const DeclaredCommand& command) {
  std::string text;
  for (const DeclaredOption& option : command.options) {
    const std::string values = option.value.empty() ? "" : ":" + zsh_quoted(option.value) + ":" + zsh_values(option);
    if (option.is_positional()) {
      text += " \\\n      '" + std::string(option.is_list ? "*" : "") + values + "'";
      continue;
    }
    for (const std::string& name : option.names)
      text += " \\\n      '" + (option.is_repeated ? "*" : "(" + joined(option.names, " ") + ")") + name + "[" +
              zsh_quoted(option.description) + "]" + (option.is_value_optional ? ":" : "") + values + "'";
  }
  return text;
}

}  // namespace

std::string bash_completion(const DeclaredCommand& program) {
  std::vector<std::string> words;
  std::string cases;
  for (const DeclaredCommand& command : program.commands) {
    words.push_back(command.name);
    cases += bash_case(command);
  }
  for (const DeclaredOption& option : program.options)
    words.insert(words.end(), option.names.begin(), option.names.end());
  return "# bash completion of sprekk, printed by 'sprekk completion bash'.\n"
         "# Files of these endings, and folders.\n"
         "_sprekk_files() {\n"
         "  local IFS=$'\\n' file\n"
         "  compopt -o filenames 2>/dev/null\n"
         "  COMPREPLY=($(compgen -d -- \"$word\"))\n"
         "  [ -n \"$1\" ] || return 0\n"
         "  for file in $(compgen -f -- \"$word\"); do\n"
         "    [[ -f $file && $file =~ \\.($1)$ ]] && COMPREPLY+=(\"$file\")\n"
         "  done\n"
         "  return 0\n"
         "}\n"
         "_sprekk_names() { \"${COMP_WORDS[0]}\" list 2>/dev/null | sed -n 's/^  \\([^ ]*\\) .*/\\1/p'; }\n"
         "_sprekk() {\n"
         "  local word=${COMP_WORDS[COMP_CWORD]} before=${COMP_WORDS[COMP_CWORD - 1]}\n"
         "  COMPREPLY=()\n"
         "  if [ \"$COMP_CWORD\" -eq 1 ]; then\n"
         "    COMPREPLY=($(compgen -W '" +
         joined(words, " ") +
         "' -- \"$word\"))\n"
         "    return\n"
         "  fi\n"
         "  case ${COMP_WORDS[1]} in\n" +
         cases +
         "  esac\n"
         "}\n"
         "complete -F _sprekk sprekk\n";
}

std::string zsh_completion(const DeclaredCommand& program) {
  std::string commands, cases;
  for (const DeclaredCommand& command : program.commands) {
    commands += "    '" + command.name + ":" + zsh_quoted(command.description) + "'\n";
    const std::string arguments = zsh_arguments(command);
    cases += "    " + command.name + ") _arguments" + arguments + " ;;\n";
  }
  return "#compdef sprekk\n"
         "# zsh completion of sprekk, printed by 'sprekk completion zsh'.\n"
         "_sprekk_names() { compadd -- ${(f)\"$(sprekk list 2>/dev/null | sed -n 's/^  \\([^ ]*\\) .*/\\1/p')\"} }\n"
         "_sprekk() {\n"
         "  local context state state_descr line\n"
         "  typeset -A opt_args\n"
         "  local -a commands=(\n" +
         commands + "  )\n  _arguments -C" + zsh_arguments(program) +
         " \\\n      '1:command:->command' '*::argument:->argument'\n"
         "  case $state in\n"
         "    command) _describe command commands; return ;;\n"
         "    argument) ;;\n"
         "    *) return ;;\n"
         "  esac\n"
         "  case $line[1] in\n" +
         cases +
         "  esac\n"
         "}\n"
         "_sprekk \"$@\"\n";
}

}  // namespace sprekk
