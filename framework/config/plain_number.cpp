// What looks like a number or a unit and is none: spellings of other programs, languages and text processors.
#include <cctype>
#include <regex>

#include "framework/config/number.hpp"
#include "framework/config/units.hpp"

namespace sprekk {
namespace {

/// Something that another program, or a reader, takes for a number or a unit.
struct Misspelling {
  std::regex pattern;
  const char* has;  ///< "'1e-17 m**2' for 'permeability' has …"
  const char* why;
  const char* replacement;  ///< of the pattern
};

const std::vector<Misspelling>& misspellings() {
  static const std::vector<Misspelling> all = {
      {std::regex(R"(\*\*)"), "'**'", "powers are written with '^'", "^"},
      {std::regex(R"(^([-+]?[0-9.]+)\s+([eE][-+]?[0-9]+))"), "a blank in its number", "", "$1$2"},
      {std::regex(R"(^([-+]?[0-9.]+)\s*[*x]\s*10\^\(?([-+]?[0-9]+)\)?(?=\s*[A-Za-z]))"),
       "a power of ten before its unit", "powers of ten are written with 'e'", "$1e$2"},
      {std::regex(R"(^10\^\(?([-+]?[0-9]+)\)?(?=\s*[A-Za-z]))"), "a power of ten before its unit",
       "powers of ten are written with 'e'", "1e$1"},
      {std::regex(R"((^|[^A-Za-z0-9_.^])([cdkmu]?m)([23])(?![A-Za-z0-9_.(]))"), "a unit without '^'",
       "powers are written with '^'", "$1$2^$3"},
      {std::regex(R"((^|[^A-Za-z0-9_.^])cc(?![A-Za-z0-9_.(]))"), "the unit 'cc'", "powers are written with '^'",
       "$1cm^3"}};
  return all;
}

}  // namespace

void require_plain_number(const std::string& text, const Origin& where, const std::string& name) {
  const auto refuse = [&](const std::string& what, const std::string& why, const std::string& advice) {
    throw InputError(where, quoted(text) + (name.empty() ? "" : " for " + quoted(name)) + " " + what, why, advice);
  };
  const std::string content = trimmed(text);
  if (const std::string other = with_exponent_e(content); !other.empty())
    refuse("has no number that can be read", "powers of ten are written with 'e'", "write " + quoted(other));
  const std::optional<LeadingNumber> number = leading_number(content);
  const bool has_comma = number && number->length + 1 < content.size() && content[number->length] == ',';
  if (has_comma && std::isdigit(static_cast<unsigned char>(content[number->length + 1])) != 0)
    refuse("has a decimal comma", "", "write decimals with a point");
  for (const auto& [minus, name_of_it] : {std::pair("\u2212", "minus sign"), std::pair("\u2013", "dash")})
    if (content.find(minus) != std::string::npos)
      refuse(std::string("has a ") + name_of_it + " that is no '-'", "it looks like one, as texts are set", "type '-'");
  for (const char* mark : {"\u201c", "\u201d", "\u201e", "\u2018", "\u2019"})
    if (content.find(mark) != std::string::npos)
      refuse(std::string("has a quotation mark ") + mark, "texts are set with such marks, and YAML does not know them",
             "type \"");
  constexpr std::size_t longest = 200;  // characters: std::regex needs a part of the stack for each
  if (content.size() > longest) return;
  for (const Misspelling& one : misspellings())
    if (std::regex_search(content, one.pattern))
      refuse(std::string("has ") + one.has, one.why,
             "write " + quoted(std::regex_replace(content, one.pattern, one.replacement)));
}

}  // namespace sprekk
