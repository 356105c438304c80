#include "framework/command_line/explain_command.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <filesystem>
#include <fstream>
#include <nlohmann/json.hpp>
#include <ostream>

#include "framework/command_line/hand_over.hpp"
#include "framework/config/describe/parameter_text.hpp"
#include "framework/config/inner_path.hpp"
#include "framework/config/node_paths.hpp"
#include "framework/config/unknown_key.hpp"
#include "framework/scene/law_kinds.hpp"
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
  for (const LawKind& laws : law_kinds()) {
    out << "\nlaws of " << laws.name << ", by " << laws.key << "\n";
    for (const auto& [name, doc] : laws.laws()) out << fmt::format("  {:<23} {}\n", name, doc);
  }
}

namespace {

/// A meaning of a name inside of types or sections, which may share it.
struct Meaning {
  std::string path, text;
  std::vector<std::string> wholes;
};

void add_meaning(std::vector<Meaning>& meanings, std::string path, std::string text, const std::string& whole) {
  for (Meaning& known : meanings)
    if (known.path == path && known.text == text) return known.wholes.push_back(whole);
  meanings.push_back({std::move(path), std::move(text), {whole}});
}

/// What a name stands for inside of a spec: its parameters and the values of choices (laws, accelerators).
void add_inside(const Spec& spec, const std::string& path, const std::string& name, const std::string& whole,
                std::vector<Meaning>& meanings) {
  for (const Parameter& parameter : spec.parameters()) {
    if (parameter.name == name) add_meaning(meanings, joined_path(path, name), explain(parameter), whole);
    for (const auto& [value, doc] : parameter.choices)
      if (value == name)
        add_meaning(meanings, joined_path(path, parameter.name) + ": " + value, "  " + doc + "\n", whole);
    if (parameter.inner) add_inside(*parameter.inner, inner_path(path, parameter), name, whole, meanings);
  }
}

void add_names(const Spec& spec, std::vector<std::string>& names) {
  for (const Parameter& parameter : spec.parameters()) {
    names.push_back(parameter.name);
    for (const auto& [value, doc] : parameter.choices) names.push_back(value);
    if (parameter.inner) add_names(*parameter.inner, names);
  }
}

std::string explanation(const std::string& name) {
  const std::vector<Explained> all = everything();
  for (const Explained& item : all)
    if (item.name == name) return explain(item.spec);
  std::vector<Meaning> meanings;
  std::vector<std::string> names;
  for (const Explained& item : all) {
    add_inside(item.spec, "", name, item.name, meanings);
    names.push_back(item.name);
  }
  if (!meanings.empty()) {
    std::string text;
    for (const Meaning& meaning : meanings)
      text += fmt::format("{}, in {}\n{}", meaning.path, fmt::join(meaning.wholes, ", "), meaning.text);
    return text;
  }
  // Names of parameters are suggested where no type is near, and are too many to be listed.
  const std::string advice = name_advice(name, names, "");
  std::vector<std::string> inner;
  for (const Explained& item : all) add_names(item.spec, inner);
  std::ranges::sort(inner);
  inner.erase(std::unique(inner.begin(), inner.end()), inner.end());
  throw InputError({"sprekk explain"}, "unknown name " + quoted(name), "it is not one of: " + listed(names),
                   advice.empty() ? name_advice(name, inner, "") : advice);
}

}  // namespace

void print_explanations(const std::vector<std::string>& names, std::ostream& out) {
  std::vector<std::string> texts;
  for (const std::string& name : names) texts.push_back(explanation(name));
  for (std::size_t i = 0; i < texts.size(); ++i) out << (i == 0 ? "" : "\n") << texts[i];
}

namespace {

/// The schema of the scenes of this program's dimension.
nlohmann::json own_schema() {
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
  return schema;
}

/// One schema for scenes in a plane and in space, which have a box with a z. Steps of schedules are the same.
nlohmann::json schema_of_both(nlohmann::json plane, nlohmann::json space) {
  nlohmann::json whole = {{"$schema", plane["$schema"]}, {"title", plane["title"]}, {"type", "object"}};
  whole["$defs"] = plane["$defs"];
  for (nlohmann::json* one : {&plane, &space})
    for (const char* key : {"$schema", "$defs", "title"}) one->erase(key);
  const nlohmann::json box = {{"required", {"box"}}, {"properties", {{"box", {{"required", {"z"}}}}}}};
  whole["if"] = {{"required", {"geometry"}}, {"properties", {{"geometry", box}}}};
  whole["then"] = space;
  whole["else"] = plane;
  return whole;
}

}  // namespace

void print_schema(std::ostream& out) {
  const nlohmann::json own = own_schema();
  const nlohmann::json schema =
      dimension == 2 ? schema_of_both(own, nlohmann::json::parse(said_by_program(3, "schema"))) : own;
  out << schema.dump(2) << "\n";
}

void print_study_schema(std::ostream& out) { out << json_schema(study_spec()); }

void write_reference(const std::string& folder) {
  std::filesystem::create_directories(folder);
  std::ofstream index(std::filesystem::path(folder) / "README.md");
  index << (dimension == 2 ? "# Reference\n\nGenerated by `sprekk reference`"
                           : "# Reference for scenes in space\n\nGenerated by `sprekk-space reference`")
        << " from the declared parameters.\n[How values are written](../values.md): units, expressions, tables, values "
           "by "
           "region and in time.\n\"The paper\" is the one that the [first page](../../README.md) names.\n";
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
