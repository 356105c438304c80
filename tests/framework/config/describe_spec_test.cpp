// What is made of a spec for people and editors: explanation, reference page, JSON schema, resolved scene.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <nlohmann/json.hpp>
#include <sstream>

#include "framework/config/describe/resolved_yaml.hpp"
#include "framework/config/spec.hpp"
#include "framework/config/yaml/parse_yaml.hpp"

namespace sprekk {
namespace {

using nlohmann::json;
using testing::HasSubstr;

struct Described {
  Data permeability = 1e-15;
  VectorData gravity;
  double density = 1000, rate = 0, tolerance = 1e-8;
  std::vector<Point> path;
  std::vector<std::string> fields;
  int cells = 1;
  bool fast = false;
  std::string solver = "direct", title;
  TensorData stress;

  Spec spec() {
    Spec inner("well", "A well.");
    inner.quantity("rate", rate, {.unit = "m^2/s", .doc = "Rate | of flow.", .required = true});
    Spec limits("limits", "Limits.");
    limits.quantity("tolerance", tolerance, {.range = strictly_between(0, 1), .doc = "Tolerance."});
    Spec spec("flow/mpfa", "Darcy flow.");
    spec.ignore("type");
    spec.data("permeability", permeability,
              {.unit = "m^2",
               .range = positive(),
               .doc = std::string(30, 'p') + " " + std::string(60, 'q') + " end.",
               .source = "Eq. 6",
               .required = true,
               .material = true});
    spec.vector("gravity", gravity, {.unit = "m/s^2", .doc = "Gravity."});
    spec.quantity("density", density, {.unit = "kg/m^3", .range = positive(), .doc = "Density.", .required = true});
    spec.tensor("stress", stress, {.unit = "Pa", .doc = "Stress."});
    spec.points("path", path, {.unit = "m", .doc = "Path."});
    spec.texts("fields", fields, {.doc = "Fields."});
    spec.text("title", title, {.doc = "Title."});
    spec.integer("cells", cells, {.range = between(1, 9), .doc = "Cells."});
    spec.flag("fast", fast, {.doc = "Fast."});
    spec.choice("solver", solver, {{"direct", "Factorization."}, {"iterative", "Krylov."}}, {.doc = "Solver."});
    spec.section("limits", limits, {.doc = "Limits."});
    spec.named_sections("wells", inner, [inner](const std::string&, const Origin&) { return inner; },
                        {.doc = "Wells."});
    spec.list_of_sections("probes", inner, [inner](int, const Origin&) { return inner; }, {.doc = "Probes."});
    spec.custom("schedule", [](const Node&) {}, {.doc = "Schedule."});
    return spec;
  }
};

TEST(Explain, says_everything_within_100_columns) {
  const std::string text = explain(Described().spec());
  EXPECT_THAT(text, HasSubstr("flow/mpfa\n  Darcy flow.\n"));
  EXPECT_THAT(text, HasSubstr("  permeability: data in m^2, > 0, required, here or in materials\n"));
  EXPECT_THAT(text, HasSubstr("end. [Eq. 6]\n"));
  EXPECT_THAT(text, HasSubstr("  solver: one of direct, iterative, default direct\n"));
  EXPECT_THAT(text, HasSubstr("        iterative: Krylov.\n"));
  EXPECT_THAT(text, HasSubstr("      tolerance: quantity, > 0 and < 1, default 1e-08\n"));
  EXPECT_THAT(text, HasSubstr("      rate: quantity in m^2/s, required\n"));
  std::istringstream lines(text);
  for (std::string line; std::getline(lines, line);) EXPECT_LE(line.size(), 100U) << line;
}

TEST(Explain, a_spec_without_parameters) {
  EXPECT_EQ(explain(Spec("empty", "Nothing.")), "empty\n  Nothing.\n\n  It has no parameters.\n");
}

TEST(ReferencePage, is_a_table_for_each_map) {
  const std::string page = reference_page(Described().spec());
  EXPECT_THAT(page, HasSubstr("# `flow/mpfa`\n\nDarcy flow.\n\n| parameter | kind |"));
  EXPECT_THAT(page, HasSubstr("| `density` | quantity | `kg/m^3` | > 0 | required | Density. |\n"));
  EXPECT_THAT(page, HasSubstr("| `cells` | integer | – | from 1 to 9 | `1` | Cells. |\n"));
  EXPECT_THAT(page, HasSubstr("\n## `wells.NAME`\n\nA well.\n\n"));
  EXPECT_THAT(page, HasSubstr("| `wells.NAME.rate` | quantity | `m^2/s` | – | required | Rate \\| of flow. |\n"));
  EXPECT_THAT(page, HasSubstr("- `iterative`: Krylov.\n"));
}

TEST(ReferencePage, every_row_has_six_cells) {
  std::istringstream lines(reference_page(Described().spec()));
  for (std::string line; std::getline(lines, line);) {
    if (line.empty() || line[0] != '|') continue;
    int bars = 0;
    for (std::size_t i = 0; i < line.size(); ++i) bars += line[i] == '|' && (i == 0 || line[i - 1] != '\\') ? 1 : 0;
    EXPECT_EQ(bars, 7) << line;
  }
}

TEST(JsonSchema, describes_the_map) {
  const Spec spec = Described().spec();
  const json schema = json::parse(json_schema(spec));
  EXPECT_EQ(schema.at("$schema"), "https://json-schema.org/draft/2020-12/schema");
  EXPECT_EQ(schema.at("title"), "flow/mpfa");
  EXPECT_EQ(schema.at("type"), "object");
  EXPECT_EQ(schema.at("additionalProperties"), false);
  EXPECT_EQ(schema.at("required"), json::parse(R"(["density"])")) << "permeability may stand in the materials";
  const json& properties = schema.at("properties");
  EXPECT_EQ(properties.at("density").at("type"), json::parse(R"(["number", "string"])"));
  EXPECT_EQ(properties.at("density").at("maximum"), 0) << "what has a unit is a text; of numbers only 0 is allowed";
  EXPECT_EQ(properties.at("cells").at("type"), "integer");
  EXPECT_EQ(properties.at("cells").at("maximum"), 9);
  EXPECT_EQ(properties.at("fast").at("type"), "boolean");
  EXPECT_EQ(properties.at("solver").at("enum"), json::parse(R"(["direct", "iterative"])"));
  EXPECT_EQ(properties.at("gravity").at("minItems"), 2);
  EXPECT_EQ(properties.at("limits").at("properties").at("tolerance").at("exclusiveMaximum"), 1);
  EXPECT_EQ(properties.at("wells").at("additionalProperties").at("required"), json::parse(R"(["rate"])"));
  EXPECT_EQ(properties.at("probes").at("items").at("additionalProperties"), false);
  EXPECT_TRUE(properties.contains("type"));
  for (const Parameter& parameter : spec.parameters()) {
    EXPECT_THAT(properties.at(parameter.name).at("description").get<std::string>(), HasSubstr(parameter.about.doc));
  }
}

TEST(ResolvedYaml, nests_by_path_with_origins) {
  const std::string text = resolved_yaml({{"name", "a", "s.yaml:1:7"},
                                          {"components.pore.k", "1e-18 m^2", "s.yaml:4:8"},
                                          {"couplers.0.type", "biot", "s.yaml:9:4"},
                                          {"couplers.0.alpha", "1", "default"},
                                          {"couplers.1.type", "aperture", "s.yaml:10:4"},
                                          {"components.pore.list", "[1, 2]", "--set"}});
  EXPECT_EQ(text, R"(name: a  # s.yaml:1:7
components:
  pore:
    k: 1e-18 m^2  # s.yaml:4:8
    list: [1, 2]  # --set
couplers:
  - type: biot  # s.yaml:9:4
    alpha: 1  # default
  - type: aperture  # s.yaml:10:4
)");
  EXPECT_EQ(parse_yaml(text, "resolved").text(),
            "{name: a, components: {pore: {k: 1e-18 m^2, list: [1, 2]}}, couplers: [{type: biot, alpha: 1}, {type: "
            "aperture}]}");
}

TEST(ResolvedYaml, the_later_of_two_values_stays) {
  EXPECT_EQ(resolved_yaml({{"a", "1", "x"}, {"a", "2", "y"}}), "a: 2  # y\n");
}

}  // namespace
}  // namespace sprekk
