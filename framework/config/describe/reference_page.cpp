// The reference page of a spec, in Markdown.
#include <algorithm>

#include "framework/config/describe/parameter_text.hpp"
#include "framework/config/inner_path.hpp"
#include "framework/config/state.hpp"
#include "framework/config/usual_range.hpp"

namespace sprekk {
namespace {

std::string cell(const std::string& text) {
  std::string result;
  for (const char c : text) {
    if (c == '|') result += '\\';
    result += c == '\n' ? ' ' : c;
  }
  return result.empty() ? " – " : " " + result + " ";
}

std::string code(const std::string& text) { return text.empty() ? "" : "`" + text + "`"; }

std::string table(const Spec& spec, const std::string& path, int level) {
  std::string text = "| parameter | kind | SI unit | range | default | meaning |\n|---|---|---|---|---|---|\n";
  for (const Parameter& parameter : spec.parameters()) {
    const bool is_code = !parameter.about.required && !parameter.default_text.empty();
    std::string meant = meaning(parameter);
    if (const UsualRange* usual = usual_range(spec, parameter.name))
      meant += " As a rule it is " + usual_text(*usual, parameter.about.unit) + " (" + usual->source + ").";
    if (const std::string formula = formula_text(spec.name(), parameter.name); !formula.empty()) meant += " " + formula;
    if (parameter.about.in_time) meant += " May change with time.";
    if (parameter.about.material) meant += " May stand in `materials`.";
    text += "|" + cell(code(path + parameter.name)) + "|" + cell(kind_text(parameter)) + "|" +
            cell(code(parameter.about.unit)) + "|" + cell(parameter.about.range.text()) + "|" +
            cell(is_code ? code(parameter.default_text) : default_text(parameter)) + "|" + cell(meant) + "|\n";
  }
  for (const Parameter& parameter : spec.parameters()) {
    if (parameter.choices.empty()) continue;
    text += "\nValues of `" + path + parameter.name + "`:\n\n";
    for (const auto& [value, doc] : parameter.choices) text += "- `" + value + "`: " + doc + "\n";
  }
  for (const Parameter& parameter : spec.parameters()) {
    if (!parameter.inner) continue;
    const std::string inside = path + inner_path("", parameter);
    text += "\n" + std::string(static_cast<std::size_t>(level), '#') + " `" + inside + "`\n\n";
    if (!parameter.inner->doc().empty()) text += parameter.inner->doc() + "\n\n";
    if (!parameter.inner->parameters().empty()) text += table(*parameter.inner, inside + ".", std::min(level + 1, 6));
  }
  return text;
}

}  // namespace

std::string reference_page(const Spec& spec) {
  std::string text = "# `" + spec.name() + "`\n\n" + spec.doc() + "\n\n";
  return text + (spec.parameters().empty() ? "It has no parameters.\n" : table(spec, "", 2));
}

}  // namespace sprekk
