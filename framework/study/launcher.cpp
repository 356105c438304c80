#include "framework/study/launcher.hpp"

#include <filesystem>

namespace sprekk {
namespace {

const std::string placeholder = "{command}";

std::string for_shell(const std::string& word) {
  std::string quoted = "'";
  for (const char c : word) quoted += c == '\'' ? std::string("'\\''") : std::string(1, c);
  return quoted + "'";
}

std::vector<std::string> words_of(const std::string& text, const Origin& origin) {
  std::vector<std::string> words;
  bool is_inside = false;
  char quote = 0;
  for (const char c : text) {
    if (quote ? c == quote : c == '\'' || c == '"') {
      quote = quote ? char(0) : c;
      if (quote && !is_inside) words.emplace_back();
      is_inside = true;
    } else if (c == ' ' && !quote) {
      is_inside = false;
    } else {
      if (!is_inside) words.emplace_back();
      is_inside = true;
      words.back() += c;
    }
  }
  if (quote)
    throw InputError(origin, "a quote in the launcher " + quoted(text) + " does not end", "", "add the other one");
  return words;
}

}  // namespace

Launcher::Launcher(const std::string& text, const Origin& origin) : text_(text), words_(words_of(text, origin)) {
  if (words_.empty())
    throw InputError(origin, "a launcher is empty", "it is a command such as 'srun -n 1'", "remove it, or write one");
}

std::vector<std::string> Launcher::words(const std::vector<std::string>& command,
                                         const std::map<std::string, std::string>& environment) const {
  std::string whole = "cd " + for_shell(std::filesystem::current_path().string()) + " && env";
  for (const auto& [name, value] : environment) whole += " " + for_shell(name + "=" + value);
  for (const std::string& word : command) whole += " " + for_shell(word);
  std::vector<std::string> result;
  bool has_placeholder = false;
  for (std::string word : words_) {
    for (std::size_t at = word.find(placeholder); at != std::string::npos;
         at = word.find(placeholder, at + whole.size())) {
      word.replace(at, placeholder.size(), whole);
      has_placeholder = true;
    }
    result.push_back(word);
  }
  if (!has_placeholder) result.insert(result.end(), command.begin(), command.end());
  return result;
}

}  // namespace sprekk
