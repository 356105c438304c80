#include "framework/config/input_error.hpp"

#include <fmt/format.h>

#include <algorithm>

namespace sprekk {
namespace {

constexpr std::size_t most_problems = 10;
constexpr std::size_t longest_quote = 80;
constexpr std::size_t most_names = 60;

std::string message(const Origin& where, const std::string& problem, const std::string& why,
                    const std::string& suggestion) {
  std::string text = where.text();
  if (!text.empty()) text += ": ";
  text += problem;
  if (!why.empty()) text += " (" + why + ")";
  if (!suggestion.empty()) text += " " + suggestion;
  return text;
}

std::string joined_lines(const std::vector<std::string>& problems) {
  std::string text;
  for (std::size_t i = 0; i < std::min(problems.size(), most_problems); ++i) {
    text += (i == 0 ? "" : "\n") + problems[i];
  }
  if (problems.size() > most_problems) {
    text += "\nand " + std::to_string(problems.size() - most_problems) + " more";
  }
  return text;
}

}  // namespace

std::string Origin::text() const {
  std::string result = source;
  if (line > 0) result += fmt::format(":{}", line);
  if (line > 0 && column > 0) result += fmt::format(":{}", column);
  return result;
}

InputError::InputError(const Origin& where, const std::string& problem, const std::string& why,
                       const std::string& suggestion)
    : InputError(message(where, problem, why, suggestion)) {}

InputError::InputError(const std::string& message) : std::runtime_error(message), problems_{message} {}

InputError::InputError(const std::vector<std::string>& problems)
    : std::runtime_error(joined_lines(problems)), problems_(problems) {}

std::string quoted(const std::string& text) {
  std::string result = "'";
  for (std::size_t i = 0; i < text.size(); ++i) {
    const auto byte = static_cast<unsigned char>(text[i]);
    const bool continues_character = (byte & 0xC0U) == 0x80U;  // UTF-8: never cut inside a character
    if (i >= longest_quote && !continues_character) return result + "…'";
    result += byte < 0x20 || byte == 0x7F ? ' ' : text[i];
  }
  return result + "'";
}

std::string listed(const std::vector<std::string>& names) {
  std::string result;
  for (std::size_t i = 0; i < names.size(); ++i) {
    if (i == most_names) return result + ", … (" + std::to_string(names.size()) + " in all)";
    result += (i == 0 ? "" : ", ") + names[i];
  }
  return result;
}

}  // namespace sprekk
