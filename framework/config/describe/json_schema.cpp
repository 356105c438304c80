// The JSON schema of a spec, for editors.
#include <algorithm>
#include <cmath>
#include <nlohmann/json.hpp>

#include "framework/config/describe/parameter_text.hpp"
#include "framework/config/state.hpp"

namespace sprekk {
namespace {

using Json = nlohmann::ordered_json;

Json map_schema(const Spec& spec);

/// Bounds apply to plain numbers; a quantity with a unit other than m may only be the plain number 0. Texts are checked
/// by the program.
void add_bounds(Json& schema, const About& about) {
  const Range range = about.unit.empty() || about.unit == "m" ? about.range : Range{.low = 0, .high = 0};
  if (std::isfinite(range.low)) schema[range.low_allowed ? "minimum" : "exclusiveMinimum"] = range.low;
  if (std::isfinite(range.high)) schema[range.high_allowed ? "maximum" : "exclusiveMaximum"] = range.high;
}

Json number_schema(const About& about) {
  Json schema = {{"type", {"number", "string"}}};
  add_bounds(schema, about);
  return schema;
}

Json list_schema(Json items) { return {{"type", "array"}, {"items", std::move(items)}}; }

Json pair_schema(Json items) {
  Json schema = list_schema(std::move(items));
  schema["minItems"] = dimension;
  schema["maxItems"] = dimension;
  return schema;
}

Json datum_schema(const About& about) {
  Json schema = number_schema(about);
  if (!about.constant_only) schema["type"] = {"number", "string", "object", "array"};
  return schema;
}

Json choice_schema(const Parameter& parameter) {
  Json schema = {{"enum", Json::array()}};
  for (const auto& [value, doc] : parameter.choices) schema["enum"].push_back(value);
  return schema;
}

Json value_schema(const Parameter& parameter) {
  const std::string& kind = parameter.kind;
  const About& about = parameter.about;
  if (kind == "quantity") return number_schema(about);
  if (kind == "data") return datum_schema(about);
  if (kind == "vector") return pair_schema(datum_schema(about));
  if (kind == "tensor") return {{"type", {"number", "string", "object", "array"}}};
  if (kind == "point") return pair_schema(number_schema(about));
  if (kind == "points") return list_schema(pair_schema(number_schema(about)));
  if (kind == "quantities") return list_schema(number_schema(about));
  if (kind == "flag") return {{"type", "boolean"}};
  if (kind == "choice") return choice_schema(parameter);
  if (kind == "text") return {{"type", {"string", "number"}}};
  if (kind == "texts") return {{"type", {"string", "number", "array"}}, {"items", {{"type", {"string", "number"}}}}};
  if (kind == "section") return map_schema(*parameter.inner);
  if (kind == "named sections") {
    Json schema = {{"type", {"object", "null"}}, {"additionalProperties", map_schema(*parameter.inner)}};
    // {table: FILE} stands for a set of this name (expand_fracture_table).
    const auto has_table = [](const Parameter& p) { return p.name == "table" && p.kind == "text"; };
    if (std::ranges::any_of(parameter.inner->parameters(), has_table))
      schema["properties"]["table"] = {{"anyOf", {Json{{"type", "string"}}, map_schema(*parameter.inner)}}};
    return schema;
  }
  if (kind == "list of sections") return list_schema(map_schema(*parameter.inner));
  if (kind != "integer") return Json::object();  // the declaring class reads it itself
  Json schema = {{"type", "integer"}};
  add_bounds(schema, about);
  return schema;
}

std::string description(const Parameter& parameter) {
  std::string text = meaning(parameter);
  for (const auto& [value, doc] : parameter.choices) text += "\n" + value + ": " + doc;
  return text + (text.empty() ? "(" : " (") + facts(parameter) + ")";
}

Json map_schema(const Spec& spec) {
  Json properties = Json::object();
  Json required = Json::array();
  for (const Parameter& parameter : spec.parameters()) {
    Json schema = value_schema(parameter);
    schema["description"] = description(parameter);
    if (const std::string formula = formula_text(spec.name(), parameter.name); !formula.empty())
      schema["description"] = schema["description"].get<std::string>() + " " + formula;
    properties[parameter.name] = std::move(schema);
    const bool must_stand_here = parameter.about.required && !parameter.about.material;
    if (must_stand_here) required.push_back(parameter.name);
  }
  for (const std::string& name : spec.ignored()) properties[name] = Json::object();
  Json schema = {{"type", "object"}, {"properties", std::move(properties)}, {"additionalProperties", false}};
  if (required.empty()) {
    schema["type"] = {"object", "null"};  // `output:` with nothing behind it
  } else {
    schema["required"] = std::move(required);
  }
  return schema;
}

}  // namespace

std::string json_schema(const Spec& spec) {
  Json schema = {
      {"$schema", "https://json-schema.org/draft/2020-12/schema"}, {"title", spec.name()}, {"description", spec.doc()}};
  schema.update(map_schema(spec));
  return schema.dump(2) + "\n";
}

}  // namespace sprekk
