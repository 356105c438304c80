// What `sprekk explain` prints: everything that a spec declares, within 100 columns.
#include <sstream>

#include "framework/config/describe/parameter_text.hpp"
#include "framework/config/state.hpp"
#include "framework/config/usual_range.hpp"

namespace sprekk {
namespace {

constexpr std::size_t width = 100;

std::size_t columns_of(const std::string& text) {
  std::size_t columns = 0;
  for (const char c : text) columns += (static_cast<unsigned char>(c) & 0xC0U) != 0x80U ? 1 : 0;  // UTF-8 characters
  return columns;
}

/// The words of `text` in lines, each with the indentation.
std::string wrapped(const std::string& text, std::size_t indentation) {
  const std::string margin(indentation, ' ');
  std::istringstream words(text);
  std::string result, line;
  for (std::string word; words >> word;) {
    const bool fits = indentation + columns_of(line) + 1 + columns_of(word) <= width;
    if (!line.empty() && !fits) {
      result += margin + line + "\n";
      line.clear();
    }
    line += (line.empty() ? "" : " ") + word;
  }
  return line.empty() ? result : result + margin + line + "\n";
}

std::string described(const Spec& spec, std::size_t indentation);

std::string described(const Parameter& parameter, std::size_t indentation) {
  std::string text = wrapped(parameter.name + ": " + facts(parameter), indentation);
  text += wrapped(meaning(parameter), indentation + 4);
  for (const auto& [value, doc] : parameter.choices) text += wrapped(value + ": " + doc, indentation + 6);
  return parameter.inner ? text + described(*parameter.inner, indentation + 4) : text;
}

std::string described(const Spec& spec, std::size_t indentation) {
  std::string text;
  for (const Parameter& parameter : spec.parameters()) {
    text += described(parameter, indentation);
    text += wrapped(formula_text(spec.name(), parameter.name), indentation + 4);
    if (const UsualRange* usual = usual_range(spec, parameter.name))
      text += wrapped("As a rule it is " + usual_text(*usual, parameter.about.unit) + " (" + usual->source + ").",
                      indentation + 4);
  }
  return text;
}

}  // namespace

std::string explain(const Parameter& parameter) { return described(parameter, 2); }

std::string explain(const Spec& spec) {
  std::string text = spec.name() + "\n" + wrapped(spec.doc(), 2);
  if (spec.parameters().empty()) return text + "\n  It has no parameters.\n";
  return text + "\n" + described(spec, 2);
}

}  // namespace sprekk
