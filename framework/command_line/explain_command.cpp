#include "framework/command_line/explain_command.hpp"

#include <algorithm>
#include <filesystem>
#include <fstream>
#include <nlohmann/json.hpp>
#include <ostream>

#include "framework/scene/registry.hpp"
#include "framework/scene/scene.hpp"
#include "framework/schedule/schedule_context.hpp"
#include "framework/study/study.hpp"

namespace sprekk {

namespace {

/// Everything that can be explained, by kind.
struct Explained {
  std::string kind;
  std::string name;
  Spec spec;
};

std::vector<Explained> everything() {
  std::vector<Explained> all;
  for (const Spec& spec : scene_section_specs()) all.push_back({"section", spec.name(), spec});
  for (const ComponentType& type : Registry::instance().components())
    all.push_back({"component", type.type, type.spec()});
  for (const CouplerType& type : Registry::instance().couplers()) all.push_back({"coupler", type.type, type.spec()});
  for (const ScheduleKind& kind : schedule_kinds()) all.push_back({"step of the schedule", kind.key, kind.spec()});
  all.push_back({"other file", "study", study_spec()});
  return all;
}

using Json = nlohmann::json;

/// The schema of one step, or of a list of steps.
Json schedule_of(const Json& step) {
  return {{"anyOf", {{{"type", "array"}, {"minItems", 1}, {"items", step}}, step}}};
}

/// The schema of a step. The steps inside of a step are a schedule, too. The options of a step stand beside its key if
/// the key is one of them, as in `{solve: [a, b], stabilize: none}`, else below it, as in `{iterate: {steps: …}}`.
Json schema_of_step(const std::string& key, Json options) {
  if (options["properties"].contains("steps")) {
    const Json description = options["properties"]["steps"]["description"];
    options["properties"]["steps"] = {{"$ref", "#/$defs/schedule"}, {"description", description}};
  }
  if (options["properties"].contains(key)) return options;
  return {{"type", "object"},
          {"description", options["description"]},
          {"properties", {{key, options}}},
          {"required", {key}},
          {"additionalProperties", false}};
}

}  // namespace

void print_list(std::ostream& out) {
  std::string kind;
  for (const Explained& item : everything()) {
    if (item.kind != kind) out << (kind.empty() ? "" : "\n") << item.kind << "s\n";
    kind = item.kind;
    out << "  " << item.name << std::string(item.name.size() < 24 ? 24 - item.name.size() : 1, ' ') << item.spec.doc()
        << "\n";
  }
}

void print_explanation(const std::string& name, std::ostream& out) {
  std::vector<std::string> names;
  for (const Explained& item : everything()) {
    if (item.name == name) {
      out << explain(item.spec);
      return;
    }
    names.push_back(item.name);
  }
  throw unknown_name({"sprekk explain", 0, 0}, "name", name, names);
}

void print_schema(std::ostream& out) {
  using nlohmann::json;
  json schema = {{"$schema", "https://json-schema.org/draft/2020-12/schema"},
                 {"title", "A scene of Sprekk"},
                 {"type", "object"},
                 {"required", {"geometry", "components", "schedule", "time"}},
                 {"additionalProperties", false}};
  json& properties = schema["properties"];
  properties["name"] = {{"type", "string"}, {"description", "Name of the scene; the file's name by default."}};
  properties["plugins"] = {
      {"description",
       "Shared libraries with further components and couplers, relative to the scene, in folders that --plugins "
       "names; see 'sprekk new'."},
      {"anyOf", {{{"type", "string"}}, {{"type", "array"}, {"items", {{"type", "string"}}}}}}};
  properties["materials"] = {{"type", "object"}, {"description", "Properties shared by all components."}};
  json materials = json::object(), components = json::array(), couplers = json::array(), steps = json::array();
  for (const Explained& item : everything()) {
    json inner = json::parse(json_schema(item.spec));
    inner.erase("$schema");
    if (item.kind == "section") properties[item.name] = inner;
    if (item.kind == "component" || item.kind == "coupler") {
      inner["properties"]["type"] = {{"const", item.name}};
      if (item.kind == "coupler") inner["properties"]["between"] = {{"type", "array"}, {"items", {{"type", "string"}}}};
      // Material properties may stand in `materials:` instead, so none is required here.
      if (inner.contains("required")) inner.erase("required");
      inner["required"] = {"type"};
      for (const Parameter& parameter : item.spec.parameters())
        if (parameter.about.material) materials[parameter.name] = inner["properties"][parameter.name];
      (item.kind == "component" ? components : couplers).push_back(inner);
    }
    if (item.kind == "step of the schedule") steps.push_back(schema_of_step(item.name, inner));
  }
  properties["materials"]["properties"] = materials;
  properties["materials"]["additionalProperties"] = false;
  properties["components"] = {{"type", "object"}, {"additionalProperties", {{"oneOf", components}}}};
  properties["couplers"] = {{"type", "array"}, {"items", {{"oneOf", couplers}}}};
  schema["$defs"]["step"] = {{"oneOf", steps}};
  schema["$defs"]["schedule"] = schedule_of({{"$ref", "#/$defs/step"}});
  properties["schedule"] = {{"$ref", "#/$defs/schedule"}, {"description", "How a time step is solved."}};
  out << schema.dump(2) << "\n";
}

void print_study_schema(std::ostream& out) { out << json_schema(study_spec()); }

void write_reference(const std::string& folder) {
  std::filesystem::create_directories(folder);
  std::ofstream index(std::filesystem::path(folder) / "README.md");
  index << "# Reference\n\nGenerated by `sprekk reference` from the declared parameters.\n[How values are "
           "written](../values.md): units, "
           "expressions, tables, values by region and in time.\n\"The paper\" is the one that the [first "
           "page](../../README.md) "
           "names.\n";
  std::string kind;
  for (const Explained& item : everything()) {
    std::string file = item.name + ".md";
    std::replace(file.begin(), file.end(), '/', '_');
    if (item.kind != kind) index << "\n## " << char(std::toupper(item.kind[0])) << item.kind.substr(1) << "s\n\n";
    kind = item.kind;
    index << "- [" << item.name << "](" << file << "): " << item.spec.doc() << "\n";
    std::ofstream(std::filesystem::path(folder) / file) << reference_page(item.spec);
  }
}

}  // namespace sprekk
