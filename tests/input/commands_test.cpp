// What the commands answer to right input.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <fstream>
#include <map>
#include <nlohmann/json.hpp>
#include <regex>
#include <set>
#include <sstream>

#include "tests/input/program.hpp"

namespace sprekk::testing {
namespace {

namespace fs = std::filesystem;
using ::testing::HasSubstr;

const std::string tutorial = config("tutorial/first_scene.yaml");

std::vector<std::string> lines_of(const std::string& text) {
  std::vector<std::string> lines;
  std::istringstream in(text);
  for (std::string line; std::getline(in, line);) lines.push_back(line);
  return lines;
}

/// The names in the answer of `list`: the first word of each line that is set in by two blanks.
std::vector<std::string> listed_names(const std::string& answer) {
  std::vector<std::string> names;
  for (const std::string& line : lines_of(answer))
    if (line.rfind("  ", 0) == 0) names.push_back(line.substr(2, line.find(' ', 2) - 2));
  return names;
}

TEST(List, NamesEverythingAndExplainKnowsIt) {
  const Folder folder;
  const Outcome list = sprekk_command({"list"}, folder.path());
  ASSERT_EQ(list.code, 0) << list.err;
  const std::vector<std::string> names = listed_names(list.out);
  for (const std::string name : {"geometry", "matrix_flow/mpfa", "poromechanics/mpsa", "biot", "solve", "iterate"})
    EXPECT_THAT(names, ::testing::Contains(name));
  for (const std::string& name : names) {
    const Outcome explained = sprekk_command({"explain", name}, folder.path());
    EXPECT_EQ(explained.code, 0) << name << ": " << explained.err;
    EXPECT_THAT(explained.out, HasSubstr(name));
  }
}

TEST(Explain, TellsUnitRangeAndSource) {
  const Folder folder;
  const Outcome explained = sprekk_command({"explain", "matrix_flow/mpfa"}, folder.path());
  for (const std::string text : {"permeability", "m^2", ">= 0", "Eq. 6", "required"})
    EXPECT_THAT(explained.out, HasSubstr(text));
}

TEST(Fractures, ATableOfARandomSetMakesTheSameMesh) {
  const Folder folder;
  const std::string scene = (fs::path(SPREKK_SOURCE_DIR) / "tests/input/base/fractured.yaml").string();
  const auto with = [&](const std::string& command, const std::string& joints) {
    const Outcome answer =
        sprekk_command({command, scene, "--set", "geometry.fractures.joints=" + joints}, folder.path());
    EXPECT_EQ(answer.code, 0) << answer.err;
    return answer.out;
  };
  const std::string drawn = with("fractures", "{random: {number: 5, length: {value: 0.2 m}, seed: 4}}");
  const std::vector<std::string> rows = lines_of(drawn);
  ASSERT_EQ(rows.size(), 7U);
  EXPECT_EQ(rows[0], "name,x1[m],y1[m],x2[m],y2[m]");
  EXPECT_EQ(rows[1].rfind("crack,0.3,0.5,0.7,0.5", 0), 0U);
  std::ofstream(folder.path() / "joints.csv")
      << rows[0] + "\n" + rows[2] + "\n" + rows[3] + "\n" + rows[4] + "\n" + rows[5] + "\n" + rows[6];
  const std::string table = "{table: " + (folder.path() / "joints.csv").string() + "}";
  EXPECT_EQ(with("fractures", table), drawn);
  EXPECT_EQ(with("check", table), with("check", "{random: {number: 5, length: {value: 0.2 m}, seed: 4}}"));
}

TEST(Schema, IsJsonWithAllSectionsAndTypes) {
  const Folder folder;
  const Outcome answer = sprekk_command({"schema"}, folder.path());
  ASSERT_EQ(answer.code, 0) << answer.err;
  const nlohmann::json schema = nlohmann::json::parse(answer.out);
  EXPECT_EQ(schema.at("$schema"), "https://json-schema.org/draft/2020-12/schema");
  // A box with a z makes a scene one in space.
  EXPECT_EQ(schema.at("if")["properties"]["geometry"]["properties"]["box"]["required"], nlohmann::json({"z"}));
  for (const std::string where : {"then", "else"}) {
    const nlohmann::json& properties = schema.at(where).at("properties");
    for (const std::string section : {"name", "geometry", "mesh", "materials", "components", "couplers", "schedule",
                                      "time", "output", "solver", "newton"})
      EXPECT_TRUE(properties.contains(section)) << where << " " << section;
    std::set<std::string> types;
    for (const auto& component : properties["components"]["additionalProperties"]["oneOf"])
      types.insert(component["properties"]["type"]["const"]);
    for (const auto& coupler : properties["couplers"]["items"]["oneOf"])
      types.insert(coupler["properties"]["type"]["const"]);
    EXPECT_TRUE(types.count("matrix_flow/tpfa") && types.count("wall_exchange")) << where;
    EXPECT_EQ(types.count("fracture_flow/mfd"), where == "then" ? 1u : 0u);
    EXPECT_EQ(types.count("matrix_flow/ntpfa"), where == "then" ? 0u : 1u);
  }
}

TEST(Show, GivesEveryValueItsOrigin) {
  const Folder folder;
  const Outcome shown = sprekk_command({"show", tutorial, "--set", "time.step=2 h"}, folder.path());
  ASSERT_EQ(shown.code, 0) << shown.err;
  const std::regex leaf(R"(^\s*(- )?[\w"./-]+: \S.*  # (.*first_scene\.yaml:\d+:\d+|default|--set [\w.]+)$)");
  const std::regex branch(R"(^\s*(- )?[\w"./-]+:$)");
  for (const std::string& line : lines_of(shown.out))
    EXPECT_TRUE(std::regex_match(line, leaf) || std::regex_match(line, branch)) << line;
  // Given, overridden, a default of a section that is there, of absent ones, of a coupler and of a step.
  EXPECT_THAT(shown.out, HasSubstr("permeability: 1e-17 m^2  # " + tutorial + ":21:17"));
  EXPECT_THAT(shown.out, HasSubstr("step: 2 h  # --set"));
  EXPECT_THAT(shown.out, HasSubstr("start: 0 s  # default"));
  EXPECT_THAT(shown.out, HasSubstr("max_iterations: 500  # default"));
  EXPECT_THAT(shown.out, HasSubstr("at_most: 30  # default"));
  EXPECT_THAT(shown.out, HasSubstr("fixed_stress_factor: 1  # default"));
  EXPECT_THAT(shown.out, HasSubstr("stabilize: none  # default"));
}

std::string without_comments(const std::string& text) { return std::regex_replace(text, std::regex("  # [^\n]*"), ""); }

TEST(Show, IsASceneThatMeansTheSame) {
  const Folder folder;
  for (const std::string scene :
       {"tutorial/first_scene.yaml", "paper/onset_coarse.yaml", "verification/terzaghi.yaml"}) {
    const Outcome shown = sprekk_command({"show", config(scene)}, folder.path());
    std::ofstream(folder / "shown.yaml") << shown.out;
    EXPECT_EQ(sprekk_command({"check", "shown.yaml"}, folder.path()).code, 0) << scene;
    const Outcome again = sprekk_command({"show", "shown.yaml"}, folder.path());
    EXPECT_EQ(without_comments(again.out), without_comments(shown.out));
  }
}

TEST(Check, AcceptsTheScenesThatComeAlong) {
  // Scenes without dimensions, one with heads and hydraulic conductivities, and a network that encloses small pockets.
  const std::map<std::string, std::string> notes = {{"berre_regular_network", "'viscosity' is '1 Pa*s'"},
                                                    {"berre_small_features", "one without dimensions"},
                                                    {"berre_single_fracture", "'viscosity' is '1 Pa*s'"},
                                                    {"biot_manufactured", "one without dimensions"},
                                                    {"complex_network", "one without dimensions"},
                                                    {"outcrop_network", "enclose 1.7 m^2 with 3 cells"},
                                                    {"regular_network", "one without dimensions"},
                                                    {"single_mode_fracture", "one without dimensions"},
                                                    {"terzaghi", "one without dimensions"}};
  const Folder folder;
  for (const fs::directory_entry& entry : fs::recursive_directory_iterator(config(""))) {
    if (entry.path().extension() != ".yaml") continue;
    if (entry.path().parent_path().filename() == "studies") {
      const Outcome listed = sprekk_command({"sweep", entry.path().string(), "--list"}, folder.path());
      EXPECT_EQ(listed.code, 0) << listed.err;
      continue;
    }
    const Outcome outcome = sprekk_command({"check", entry.path().string()}, folder.path());
    EXPECT_EQ(outcome.code, 0) << outcome.err;
    const auto told = notes.find(entry.path().stem().string());
    if (told == notes.end())
      EXPECT_EQ(outcome.err, "") << entry.path();
    else
      EXPECT_THAT(outcome.err, HasSubstr(told->second)) << entry.path();
    EXPECT_THAT(outcome.out, HasSubstr(": ok, "));
  }
  EXPECT_TRUE(fs::is_empty(folder.path()));
}

TEST(Check, NotesMaterialsThatNothingUses) {
  const Folder folder;
  const Outcome outcome = sprekk_command(
      {"check", std::string(SPREKK_SOURCE_DIR) + "/tests/input/base/flow.yaml", "--set", "materials.friction=0.6"},
      folder.path());
  EXPECT_EQ(outcome.code, 0);
  EXPECT_THAT(outcome.err, HasSubstr("note: --set materials.friction: no component of this scene uses 'friction'"));
}

TEST(Graph, ShowsComponentsCouplersAndSchedule) {
  const Folder folder;
  const Outcome printed = sprekk_command({"graph", tutorial}, folder.path());
  ASSERT_EQ(printed.code, 0) << printed.err;
  for (const std::string text : {"digraph \"first_scene\"", "matrix_flow/mpfa", "wall_traction", "solve pore rock"})
    EXPECT_THAT(printed.out, HasSubstr(text));
  ASSERT_EQ(sprekk_command({"graph", tutorial, "-o", "graph.dot"}, folder.path()).code, 0);
  EXPECT_EQ(text_of(folder / "graph.dot"), printed.out);
}

TEST(Graph, IsDrawnByGraphvizOrSaysThatItIsMissing) {
  const Folder folder;
  const Outcome drawn = sprekk_command({"graph", tutorial, "-o", "graph.svg"}, folder.path());
  if (drawn.code == 0) {
    EXPECT_THAT(text_of(folder / "graph.svg"), HasSubstr("<svg"));
    EXPECT_FALSE(fs::exists(folder / "graph.svg.dot"));
  } else {
    EXPECT_EQ(drawn.code, 2);
    EXPECT_THAT(drawn.err, HasSubstr("install graphviz, or write a .dot file"));
    EXPECT_TRUE(fs::is_empty(folder.path()));
  }
}

TEST(SceneFiles, LaterOnesWinAndSettingsWinOverThem) {
  const Folder folder;
  std::ofstream(folder / "one.yaml") << "time: {end: 3 day}\nmesh: {size: 1 m}\n";
  std::ofstream(folder / "two.yaml") << "time: {end: 4 day, step: 6 h}\noutput: null\n";
  const Outcome shown = sprekk_command(
      {"show", tutorial, "one.yaml", "two.yaml", "--set", "time.step=1 h", "--set", "name=mine"}, folder.path());
  ASSERT_EQ(shown.code, 0) << shown.err;
  for (const std::string& text :
       std::vector<std::string>{"end: 4 day  # two.yaml:1:13", "size: 1 m  # one.yaml:2:14", "step: 1 h  # --set",
                                "name: mine  # --set", "fracture_size: 0.1 m  # " + tutorial})
    EXPECT_THAT(shown.out, HasSubstr(text));
  EXPECT_THAT(shown.out, ::testing::Not(HasSubstr("probes")));
}

}  // namespace
}  // namespace sprekk::testing
