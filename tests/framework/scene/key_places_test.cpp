// No key of a scene is ever ignored. From the specs follows every place where a key can stand; each unknown and each
// misplaced key there is refused with its place, and with the place where it belongs.
#include "framework/scene/key_places.hpp"

#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <map>
#include <regex>
#include <set>

#include "framework/config/yaml/parse_yaml.hpp"
#include "framework/scene/registry.hpp"
#include "framework/scene/scene.hpp"
#include "framework/schedule/schedule_context.hpp"

namespace sprekk {
namespace {

using testing::HasSubstr;
using testing::StartsWith;

const char* const unknown = "no_such_key";

/// A map that keys can stand in: the spec of the map, and the scene around it with "@" for its entries.
struct Place {
  std::string name;
  const Spec* spec;
  std::string scene;
};

/// A scene without this section, and with `section` for it.
std::string scene_with(const std::string& section, const std::string& key) {
  const std::pair<const char*, const char*> sections[] = {
      {"geometry",
       "geometry: {box: {x: [0, 1], y: [0, 1]}, fractures: {crack: {points: [[0.3, 0.5], [0.7, 0.5]]}}, regions: "
       "{core: "
       "{polygon: [[0, 0], [0.2, 0], [0.2, 0.2]]}}}"},
      {"components",
       "components: {pore: {type: matrix_flow/mpfa, permeability: 1e-13 m^2, viscosity: 1 mPa*s, storage: 1e-9 1/Pa}}"},
      {"schedule", "schedule: [{solve: pore}]"},
      {"time", "time: {end: 1 s, step: 1 s}"}};
  std::string text = section + "\n";
  for (const auto& [name, line] : sections)
    if (name != key) text += std::string(line) + "\n";
  return text;
}

/// Adds the map of a spec and the maps inside. `around`: the entries of the map with "@" for them.
void add_places(std::vector<Place>& places, const std::string& name, const Spec& spec, const std::string& around) {
  places.push_back({name, &spec, around});
  for (const Parameter& parameter : spec.parameters()) {
    if (!parameter.inner) continue;
    const std::string open = parameter.kind == "section" ? "{" : parameter.kind == "named sections" ? "{left: {" : "[{";
    const std::string close = parameter.kind == "section" ? "}" : parameter.kind == "named sections" ? "}}" : "}]";
    std::string inside = around;
    inside.replace(inside.find('@'), 1, parameter.name + ": " + open + "@" + close);
    add_places(places, name + "." + parameter.name, *parameter.inner, inside);
  }
}

/// All specs, which the places point into.
struct Specs {
  std::vector<Spec> sections = scene_section_specs(), steps, components, couplers;
  Specs() {
    for (const ScheduleKind& kind : schedule_kinds()) steps.push_back(kind.spec());
    for (const ComponentType& type : Registry::instance().components()) components.push_back(type.spec());
    for (const CouplerType& type : Registry::instance().couplers()) couplers.push_back(type.spec());
  }
};

std::set<std::string> keys_of(const Spec& spec) {
  std::set<std::string> keys(spec.ignored().begin(), spec.ignored().end());
  for (const Parameter& parameter : spec.parameters()) keys.insert(parameter.name);
  return keys;
}

const std::vector<Place>& all_places() {
  static const Specs specs;
  static const std::vector<Place> places = [] {
    std::vector<Place> all;
    for (const Spec& spec : specs.sections)
      add_places(all, spec.name(), spec, scene_with(spec.name() + ": {@}", spec.name()));
    for (std::size_t i = 0; i < specs.steps.size(); ++i) {
      const Spec& spec = specs.steps[i];
      const std::string key = schedule_kinds()[i].key;
      const std::string steps = keys_of(spec).count("steps") > 0 ? "steps: [{solve: pore}], " : "";
      const std::string entry =
          keys_of(spec).count(key) > 0 ? key + ": pore, " + steps + "@" : key + ": {" + steps + "@}";
      add_places(all, "step " + key, spec, scene_with("schedule: [{" + entry + "}]", "schedule"));
    }
    for (const Spec& spec : specs.components)
      add_places(all, spec.name(), spec,
                 scene_with("components: {pore: {type: " + spec.name() + ", @}}", "components"));
    for (const Spec& spec : specs.couplers)
      add_places(all, spec.name(), spec,
                 scene_with("couplers: [{type: " + spec.name() + ", between: [pore], @}]", "couplers"));
    return all;
  }();
  return places;
}

/// The keys of all places.
const std::set<std::string>& all_keys() {
  static const std::set<std::string> keys = [] {
    std::set<std::string> all;
    for (const Place& place : all_places()) all.merge(keys_of(*place.spec));
    return all;
  }();
  return keys;
}

std::string with(const std::string& scene, const std::string& entries) {
  std::string text = scene;
  text.replace(text.find('@'), 1, entries);
  return text;
}

std::vector<std::string> problems_of(const std::string& scene) {
  try {
    read_scene(parse_yaml(scene, "s.yaml"), ".", "scene");
  } catch (const InputError& error) {
    return error.problems();
  }
  return {};
}

/// The problem that names each of the keys as unknown.
std::map<std::string, std::string> problems_by_key(const std::string& scene) {
  std::map<std::string, std::string> problems;
  // "unknown key 'a' in …", "unknown key of 'permeability': 'a' …"
  const std::regex unknown_key(" unknown (?:key of '[^']*': |[^']*)'([^']*)'");
  for (const std::string& problem : problems_of(scene))
    if (std::smatch found; std::regex_search(problem, found, unknown_key)) problems[found[1]] = problem;
  return problems;
}

/// "s.yaml:3:7" for the key in a scene of short lines.
std::string origin_of(const std::string& scene, const std::string& entry) {
  const std::size_t at = scene.find(entry);
  const std::size_t line_begin = scene.rfind('\n', at) == std::string::npos ? 0 : scene.rfind('\n', at) + 1;
  return fmt::format("s.yaml:{}:{}: ", 1 + std::count(scene.begin(), scene.begin() + static_cast<long>(at), '\n'),
                     at - line_begin + 1);
}

class EachPlace : public testing::TestWithParam<Place> {};

TEST_P(EachPlace, RefusesAnUnknownKeyWithItsPlace) {
  const std::string scene = with(GetParam().scene, std::string(unknown) + ": 1");
  const auto problems = problems_by_key(scene);
  ASSERT_EQ(problems.count(unknown), 1U) << scene << "\n" << testing::PrintToString(problems_of(scene));
  EXPECT_THAT(problems.at(unknown), StartsWith(origin_of(scene, unknown)));
}

TEST_P(EachPlace, RefusesEveryMisplacedKeyAndSaysWhereItBelongs) {
  const std::set<std::string> own = keys_of(*GetParam().spec);
  // A second kind of step beside the first one is another mistake.
  std::set<std::string> kinds;
  if (GetParam().name.rfind("step ", 0) == 0 && GetParam().name.find('.') == std::string::npos)
    for (const ScheduleKind& kind : schedule_kinds()) kinds.insert(kind.key);
  std::set<std::string> foreign;
  std::string entries;
  for (const std::string& key : all_keys())
    if (own.count(key) == 0 && kinds.count(key) == 0 &&
        GetParam().scene.find("{" + key + ": pore, ") == std::string::npos &&
        GetParam().scene.find(" " + key + ": [{solve") == std::string::npos) {
      foreign.insert(key);
      entries += (entries.empty() ? "\"" : ", \"") + key + "\": 1";
    }
  const std::string scene = with(GetParam().scene, entries);
  const auto problems = problems_by_key(scene);
  for (const std::string& key : foreign) {
    ASSERT_EQ(problems.count(key), 1U) << key << " in " << GetParam().name;
    EXPECT_THAT(problems.at(key), StartsWith(origin_of(scene, "\"" + key + "\"")));
    EXPECT_THAT(problems.at(key), HasSubstr("'" + key + "' belongs "));
  }
}

std::string test_name(const std::string& text) {
  std::string name;
  for (const char c : text) name += std::isalnum(static_cast<unsigned char>(c)) != 0 ? c : '_';
  return name;
}

INSTANTIATE_TEST_SUITE_P(all, EachPlace, testing::ValuesIn(all_places()),
                         [](const auto& info) { return test_name(info.param.name); });

/// The forms of a value that are maps, with "@" for a further entry.
std::vector<std::string> forms_of(const std::string& kind) {
  std::vector<std::string> forms = {"{@}"};
  if (kind != "data" && kind != "vector" && kind != "tensor") return forms;
  for (const char* form : {"{value: 1, @}", "[{value: 1, @}]", "{regions: {core: 1, default: 1}, @}",
                           "{regions: {core: 1, default: 1, @}}", "{fractures: {crack: 1, default: 1}, @}",
                           "{fractures: {crack: 1, default: 1, @}}", "{table: t.csv, @}", "{column: a, @}",
                           "{run: results, of: pore.pressure, @}"})
    forms.emplace_back(kind == "vector" ? fmt::format("[{}, 0]", form) : form);
  if (kind != "tensor") return forms;
  for (const char* form : {"{xx: 1, yy: 1, @}", "{along: 1, across: 1, angle: 1, @}"}) forms.emplace_back(form);
  return forms;
}

TEST(EachValue, RefusesAMapWithAnUnknownKey) {
  for (const Place& place : all_places())
    for (const Parameter& parameter : place.spec->parameters()) {
      if (parameter.inner || parameter.kind == "custom") continue;
      for (const std::string& form : forms_of(parameter.kind)) {
        const std::string value = with(form, std::string(unknown) + ": 1");
        const std::string scene = with(place.scene, "\"" + parameter.name + "\": " + value);
        const std::vector<std::string> problems = problems_of(scene);
        EXPECT_THAT(problems, testing::Contains(testing::AnyOf(HasSubstr(unknown), HasSubstr(parameter.name))))
            << scene << "\n"
            << testing::PrintToString(problems);
      }
    }
}

TEST(MisplacedKeys, AreRefusedInTheValuesOfDataToo) {
  const Place& pore = *std::ranges::find(all_places(), "matrix_flow/mpfa", &Place::name);
  for (const std::string& form : forms_of("tensor")) {
    const std::string scene = with(pore.scene, "permeability: " + with(form, "until: 1"));
    const auto problems = problems_by_key(scene);
    ASSERT_EQ(problems.count("until"), 1U) << form << testing::PrintToString(problems_of(scene));
    EXPECT_THAT(problems.at("until"), StartsWith(origin_of(scene, "until")));
    EXPECT_THAT(problems.at("until"), HasSubstr("'until' belongs in a step 'iterate'"));
  }
}

TEST(MisplacedKeys, AreRefusedBesideIterateAndSubcycle) {
  for (const std::string step : {"iterate", "subcycle"})
    for (const Place& place : all_places()) {
      if (place.name != "step " + step) continue;
      for (const Parameter& parameter : place.spec->parameters()) {
        const std::string scene =
            scene_with("schedule:\n  - " + step + ": {" + (step == "subcycle" ? "count: 2, " : "") +
                           "steps: [{solve: pore}]}\n    " + parameter.name + ": 1",
                       "schedule");
        const auto problems = problems_by_key(scene);
        ASSERT_EQ(problems.count(parameter.name), 1U) << scene;
        EXPECT_THAT(problems.at(parameter.name), StartsWith("s.yaml:3:5: unknown key"));
        EXPECT_THAT(problems.at(parameter.name), HasSubstr("belongs in 'schedule.0." + step + "'"));
      }
    }
}

TEST(MisplacedKeys, AreRefusedAtTheTopInMaterialsAndAsSteps) {
  std::set<std::string> materials;
  for (const Place& place : all_places())
    for (const Parameter& parameter : place.spec->parameters())
      if (parameter.about.material) materials.insert(parameter.name);
  const std::set<std::string> sections = {"name",       "plugins",  "geometry", "mesh", "materials",
                                          "components", "couplers", "schedule", "time", "start",
                                          "output",     "solver",   "newton"};
  const std::set<std::string> steps = {"solve", "iterate", "subcycle", "when", "grow"};
  const auto expect_refused = [](const std::string& scene, const std::string& key) {
    const auto problems = problems_by_key(scene);
    ASSERT_EQ(problems.count(key), 1U) << scene;
    EXPECT_THAT(problems.at(key), HasSubstr("'" + key + "' belongs ")) << scene;
  };
  for (const std::string& key : all_keys()) {
    if (sections.count(key) == 0) expect_refused(scene_with("\"" + key + "\": 1", key), key);
    if (materials.count(key) == 0) expect_refused(scene_with("materials: {\"" + key + "\": 1}", key), key);
    if (steps.count(key) == 0) expect_refused(scene_with("schedule: [{\"" + key + "\": 1}]", "schedule"), key);
  }
}

TEST(KeyPlaces, NamesWhatTheSceneHasFirst) {
  const KeyPlaces places(parse_yaml("components: {water: {type: matrix_flow/tpfa}}", "s.yaml"), {"mesh"},
                         scene_section_specs());
  EXPECT_EQ(places.text("mesh"), "'mesh' belongs at the top of the scene");
  EXPECT_EQ(places.text("every"), "'every' belongs in 'output'");
  EXPECT_EQ(places.text("until"), "'until' belongs in a step 'iterate'");
  EXPECT_EQ(places.text("iterate"), "'iterate' belongs in 'schedule', as a step");
  EXPECT_EQ(places.text("porosity"), "'porosity' belongs in 'materials' or in a component matrix_flow/tpfa");
  EXPECT_EQ(places.text("from"),
            "'from' belongs in 'geometry.fractures.NAME.random.length' or in 'start' or in 'output.lines.NAME'");
  EXPECT_EQ(places.text("xx"), "'xx' belongs in a value {xx: …, yy: …, xy: …}");
  EXPECT_EQ(places.text("nothing"), "");
}

}  // namespace
}  // namespace sprekk
