#include "framework/config/describe/parameter_text.hpp"

namespace sprekk {

std::string kind_text(const Parameter& parameter) {
  if (parameter.kind != "choice") return parameter.kind;
  std::string text = "one of ";
  for (std::size_t i = 0; i < parameter.choices.size(); ++i) {
    text += (i == 0 ? "" : ", ") + parameter.choices[i].first;
  }
  return text;
}

std::string default_text(const Parameter& parameter) {
  if (parameter.about.required) return "required";
  return parameter.default_text.empty() ? "none" : parameter.default_text;
}

std::string facts(const Parameter& parameter) {
  const About& about = parameter.about;
  std::string text = kind_text(parameter);
  if (!about.unit.empty()) text += " in " + about.unit;
  if (!about.range.text().empty()) text += ", " + about.range.text();
  if (about.constant_only) text += ", constant";
  if (about.in_time) text += ", may change with time";
  if (about.required) {
    text += ", required";
  } else if (!parameter.default_text.empty()) {
    text += ", default " + parameter.default_text;
  } else {
    text += ", optional";
  }
  return about.material ? text + ", here or in materials" : text;
}

std::string meaning(const Parameter& parameter) {
  const About& about = parameter.about;
  if (about.source.empty()) return about.doc;
  return about.doc + (about.doc.empty() ? "[" : " [") + about.source + "]";
}

}  // namespace sprekk
