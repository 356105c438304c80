#include "framework/output/xml_escape.hpp"

#include <array>
#include <utility>

namespace sprekk {
namespace {

constexpr std::array<std::pair<const char*, char>, 4> xml_entities{
    {{"&lt;", '<'}, {"&gt;", '>'}, {"&quot;", '"'}, {"&amp;", '&'}}};

}  // namespace

std::string xml_escaped(const std::string& text) {
  std::string result;
  for (const char c : text) {
    const char* entity = nullptr;
    for (const auto& [name, character] : xml_entities)
      if (c == character) entity = name;
    entity ? result += entity : result += c;
  }
  return result;
}

std::string xml_unescaped(std::string text) {
  for (const auto& [name, character] : xml_entities)
    for (std::size_t at = 0; (at = text.find(name, at)) != std::string::npos; ++at)
      text.replace(at, std::string(name).size(), 1, character);
  return text;
}

}  // namespace sprekk
