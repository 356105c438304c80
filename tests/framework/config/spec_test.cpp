#include <map>

#include "framework/config/spec.hpp"
#include "framework/config/yaml/parse_yaml.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "tests/framework/config/messages.hpp"

namespace sprekk {
namespace {

using testing::ElementsAre;
using testing::HasSubstr;
using testing::IsEmpty;
using testing::Not;

/// One parameter of every kind.
struct Options {
  TensorData permeability;
  Data viscosity = 1e-3;
  std::optional<Data> source;
  VectorData gravity;
  double density = 1000;
  std::optional<double> storage;
  Point centre = Point::Zero();
  std::vector<Point> path;
  std::vector<double> times;
  int cells = 10;
  bool fast = true;
  std::string title = "none";
  std::optional<std::string> note;
  std::vector<std::string> fields;
  std::string solver = "direct";
  double tolerance = 1e-8;
  bool output_given = false;
  double interval = 5;
  std::map<std::string, std::shared_ptr<double>> wells;
  std::vector<std::shared_ptr<double>> probes;
  std::string schedule;

  Spec spec() {
    Spec spec("flow/test", "A component for tests.");
    spec.ignore("type");
    spec.tensor("permeability", permeability,
                {.unit = "m^2", .range = positive(), .doc = "Permeability.", .required = true, .material = true});
    spec.data("viscosity", viscosity, {.unit = "Pa*s", .range = positive(), .doc = "Viscosity.", .material = true});
    spec.data("source", source, {.unit = "1/s", .doc = "Source.", .in_time = true});
    spec.vector("gravity", gravity, {.unit = "m/s^2", .doc = "Gravity."});
    spec.quantity("density", density, {.unit = "kg/m^3", .range = positive(), .doc = "Density."});
    spec.quantity("storage", storage, {.unit = "1/Pa", .range = non_negative(), .doc = "Storage."});
    spec.point("centre", centre, {.unit = "m", .doc = "Centre."});
    spec.points("path", path, {.unit = "m", .doc = "Path."});
    spec.quantities("times", times, {.unit = "s", .range = non_negative(), .doc = "Times."});
    spec.integer("cells", cells, {.range = between(1, 100), .doc = "Cells."});
    spec.flag("fast", fast, {.doc = "Whether it is fast."});
    spec.text("title", title, {.doc = "Title."});
    spec.text("note", note, {.doc = "Note."});
    spec.texts("fields", fields, {.doc = "Fields."});
    spec.choice("solver", solver, {{"direct", "Factorization."}, {"iterative", "Krylov."}}, {.doc = "Solver."});
    Spec limits("limits", "Limits of iterations.");
    limits.quantity("tolerance", tolerance, {.range = strictly_between(0, 1), .doc = "Tolerance."});
    spec.section("limits", limits, {.doc = "Limits."});
    Spec output("output", "Output.");
    output.quantity("interval", interval, {.unit = "s", .doc = "Interval."});
    spec.section("output", output, {.doc = "Output."}, &output_given);
    spec.named_sections(
        "wells", well(example_),
        [this](const std::string& key, const Origin&) { return well(*(wells[key] = std::make_shared<double>(0))); },
        {.doc = "Wells."});
    spec.list_of_sections("probes", well(example_),
                          [this](int, const Origin&) {
                            probes.push_back(std::make_shared<double>(0));
                            return well(*probes.back());
                          },
                          {.doc = "Probes."});
    spec.custom("schedule", [this](const Node& node) { schedule = node.text(); }, {.doc = "Schedule."});
    spec.check([this](const Node& whole) {
      if (cells == 13) throw InputError(whole.origin, "13 cells bring bad luck");
    });
    return spec;
  }

  static Spec well(double& rate) {
    Spec spec("well", "A well.");
    spec.quantity("rate", rate, {.unit = "m^2/s", .doc = "Rate.", .required = true});
    return spec;
  }

  double example_ = 0;
};

Options read(const std::string& yaml, const ReadContext& context = {}) {
  Options options;
  options.spec().read(parse_yaml(yaml, "s.yaml"), context);
  return options;
}

std::string error(const std::string& yaml, const ReadContext& context = {}) {
  return input_error_of([&] { read(yaml, context); });
}

TEST(SpecRead, takes_defaults) {
  const Options options = read("permeability: 1 m^2");
  EXPECT_EQ(options.density, 1000);
  EXPECT_FALSE(options.source);
  EXPECT_FALSE(options.storage);
  EXPECT_FALSE(options.note);
  EXPECT_FALSE(options.output_given);
}

TEST(SpecRead, takes_what_is_given) {
  const Options options = read(R"(
type: flow/test
permeability: {xx: 2 m^2, yy: 1 m^2}
viscosity: 2 mPa*s
source: {value: 1 1/s, from: 3 s}
gravity: [0, -9.81 m/s^2]
density: 1.2 g/cm^3
storage: 4e-10 1/Pa
centre: [1 km, 2]
path: [[0, 0], [1, 2 m]]
times: [1 h, 2 s]
cells: 7
fast: no
title: "a: b"
note: text
fields: [p, u]
solver: iterative
limits: {tolerance: 1e-3}
output:
wells: {north: {rate: 1 m^2/s}, south: {rate: 2 l/m/s}}
probes: [{rate: 3 m^2/s}, {rate: 4 m^2/s}]
schedule: [{solve: [a, b]}]
)");
  EXPECT_EQ(options.permeability.component[0].at({}), 2);
  EXPECT_EQ(options.viscosity.at({}), 2e-3);
  ASSERT_TRUE(options.source);
  EXPECT_THAT(options.source->switch_times(), ElementsAre(3));
  EXPECT_EQ(options.gravity.at({}), Point(0, -9.81));
  EXPECT_DOUBLE_EQ(options.density, 1200);
  EXPECT_EQ(options.storage, 4e-10);
  EXPECT_EQ(options.centre, Point(1000, 2));
  EXPECT_EQ(options.path[1], Point(1, 2));
  EXPECT_THAT(options.times, ElementsAre(3600, 2));
  EXPECT_EQ(options.cells, 7);
  EXPECT_FALSE(options.fast);
  EXPECT_EQ(options.title, "a: b");
  EXPECT_EQ(options.note, "text");
  EXPECT_THAT(options.fields, ElementsAre("p", "u"));
  EXPECT_EQ(options.solver, "iterative");
  EXPECT_EQ(options.tolerance, 1e-3);
  EXPECT_TRUE(options.output_given);
  EXPECT_DOUBLE_EQ(*options.wells.at("south"), 2e-3);
  EXPECT_EQ(*options.probes.at(1), 4);
  EXPECT_EQ(options.schedule, "[{solve: [a, b]}]");
}

TEST(SpecRead, one_text_is_a_list_of_one) {
  EXPECT_THAT(read("{permeability: 1 m^2, fields: p}").fields, ElementsAre("p"));
}

struct Wrong {
  const char* yaml;
  const char* message;
};

class WrongParameter : public testing::TestWithParam<Wrong> {};

TEST_P(WrongParameter, is_refused) {
  EXPECT_EQ(error(std::string("permeability: 1 m^2\n") + GetParam().yaml), GetParam().message);
}

INSTANTIATE_TEST_SUITE_P(
    all, WrongParameter,
    testing::Values(
        Wrong{"density: 0", "s.yaml:2:10: 'density' is '0', out of range (it must be > 0 kg/m^3)"},
        Wrong{"density: 3 s",
              "s.yaml:2:10: '3 s' for 'density' has the dimension of time (needed is density, in kg/m^3) give it in a "
              "unit like kg/m^3"},
        Wrong{"density: [1]", "s.yaml:2:10: 'density' is a list (needed is one number, in kg/m^3)"},
        Wrong{"density:", "s.yaml:2:1: 'density' has no value (needed is one number, in kg/m^3)"},
        Wrong{"centre: [1]", "s.yaml:2:9: 'centre' has 1 coordinates (needed is a point [x, y] in m)"},
        Wrong{"centre: 1", "s.yaml:2:9: 'centre' is '1' (needed is a point [x, y] in m)"},
        Wrong{"path: [1]", "s.yaml:2:8: 'path' is '1' (needed is a point [x, y] in m)"},
        Wrong{"path: 1", "s.yaml:2:7: 'path' is '1' (needed is a list of points [[x, y], …])"},
        Wrong{"times: 5", "s.yaml:2:8: 'times' is '5' (needed is a list [a, b, …])"},
        Wrong{"times: [1 s, -5 s]", "s.yaml:2:14: 'times' is '-5 s', out of range (it must be >= 0 s)"},
        Wrong{"cells: 2.5", "s.yaml:2:8: 'cells' is '2.5' (needed is a whole number)"},
        Wrong{"cells: 101", "s.yaml:2:8: 'cells' is '101', out of range (it must be from 1 to 100)"},
        Wrong{"cells: 99999999999", "s.yaml:2:8: 'cells' is '99999999999' (too large for a whole number)"},
        Wrong{"cells: 13", "s.yaml:1:1: 13 cells bring bad luck"},
        Wrong{"fast: maybe", "s.yaml:2:7: 'fast' is 'maybe' (needed is true or false)"},
        Wrong{"title: [a]", "s.yaml:2:8: 'title' is a list (needed is one value)"},
        Wrong{"fields: {a: 1}", "s.yaml:2:9: 'fields' is a map (needed is one name or a list of names)"},
        Wrong{"solver: drect",
              "s.yaml:2:9: unknown value of 'solver': 'drect' (it is not one of: direct, iterative) did you mean "
              "'direct'?"},
        Wrong{"limits: 3", "s.yaml:2:9: 'limits' is '3' (needed is a map of parameters)"},
        Wrong{"limits: {tol: 3}",
              "s.yaml:2:10: unknown key 'tol' in 'limits' (limits has: tolerance) did you mean 'tolerance'?"},
        Wrong{"limits: {tolerance: 1}", "s.yaml:2:21: 'tolerance' is '1', out of range (it must be > 0 and < 1)"},
        Wrong{"wells: {north: {}}", "s.yaml:2:16: 'rate' is missing in 'wells.north' (Rate.) add 'rate:' in m^2/s"},
        Wrong{"wells: [1]", "s.yaml:2:8: 'wells' is a list (needed is a map of names)"},
        Wrong{"probes: {a: 1}", "s.yaml:2:9: 'probes' is a map (needed is a list of maps)"},
        Wrong{"probes: [{rate: 1 m^2/s}, 3]", "s.yaml:2:27: 'probes.1' is '3' (needed is a map of parameters)"}));

TEST(SpecRead, answers_an_unknown_key_with_all_and_the_nearest) {
  const std::string message = error("a: 1");
  EXPECT_THAT(message, HasSubstr("s.yaml:1:1: unknown key 'a' in the scene (flow/test has: permeability, viscosity, "));
  EXPECT_THAT(message,
              HasSubstr("s.yaml:1:1: 'permeability' is missing in the scene (Permeability.) add 'permeability:' "
                        "in m^2, here or in 'materials'"));
}

TEST(SpecRead, a_misspelt_required_key_is_one_mistake) {
  const std::string message = error("permeabilty: 1");
  EXPECT_THAT(message, HasSubstr("did you mean 'permeability'?"));
  EXPECT_THAT(message, Not(HasSubstr("is missing")));
}

TEST(SpecRead, tells_all_mistakes_at_once) {
  EXPECT_EQ(
      error("permeability: 1 s\ncells: 0\nwells: {a: {}, b: {rate: x}}"),
      "s.yaml:1:15: '1 s' for 'permeability' has the dimension of time (needed is area, in m^2) give it in a unit "
      "like m^2\n"
      "s.yaml:2:8: 'cells' is '0', out of range (it must be from 1 to 100)\n"
      "s.yaml:3:12: 'rate' is missing in 'wells.a' (Rate.) add 'rate:' in m^2/s\n"
      "s.yaml:3:26: 'x' for 'rate' is not a number with a unit (needed is m^2/s)");
}

TEST(SpecRead, refuses_what_is_no_map) {
  EXPECT_EQ(error("[1]"), "s.yaml:1:1: 'flow/test' is a list (needed is a map of parameters)");
}

class Materials : public testing::Test {
 protected:
  Materials() {
    context_.materials = whole_.find("materials");
    context_.material_used = [this](const std::string& key) { used_.push_back(key); };
    context_.record = [this](const std::string& path, const std::string& value, const std::string& origin) {
      records_[path] = value + " from " + origin;
    };
  }
  const Node whole_ = parse_yaml("materials: {permeability: 5 m^2, viscosity: 7 Pa*s, density: 9 kg/m^3}", "m.yaml");
  std::vector<std::string> used_;
  std::map<std::string, std::string> records_;
  ReadContext context_;
};

TEST_F(Materials, fill_what_the_component_does_not_say) {
  const Options options = read("viscosity: 3 Pa*s", context_);
  EXPECT_EQ(options.permeability.component[0].at({}), 5);
  EXPECT_EQ(options.viscosity.at({}), 3);
  EXPECT_EQ(options.density, 1000) << "density is not declared as a material";
  EXPECT_THAT(used_, ElementsAre("permeability", "viscosity"));
  EXPECT_EQ(records_.at("permeability"), "5 m^2 from m.yaml:1:27");
  EXPECT_EQ(records_.at("viscosity"), "3 Pa*s from s.yaml:1:12");
}

TEST_F(Materials, are_checked_where_they_stand) {
  const Node wrong = parse_yaml("materials: {permeability: 5 s}", "m.yaml");
  context_.materials = wrong.find("materials");
  EXPECT_THAT(error("cells: 3", context_), HasSubstr("m.yaml:1:27: '5 s' for 'permeability'"));
}

TEST_F(Materials, every_parameter_is_recorded) {
  read(
      "{permeability: 1 m^2, wells: {a: {rate: 2 m^2/s}}, probes: [{rate: 1 m^2/s}], schedule: [{solve: a}], title: "
      "'a: b'}",
      context_);
  EXPECT_EQ(records_.at("permeability"), "1 m^2 from s.yaml:1:16");
  EXPECT_EQ(records_.at("density"), "1000 kg/m^3 from default");
  EXPECT_EQ(records_.at("gravity"), "[0 m/s^2, 0 m/s^2] from default");
  EXPECT_EQ(records_.at("path"), "[] from default");
  EXPECT_EQ(records_.at("fast"), "true from default");
  EXPECT_EQ(records_.at("limits.tolerance"), "1e-08 from default");
  EXPECT_EQ(records_.at("wells.a.rate"), "2 m^2/s from s.yaml:1:41");
  EXPECT_EQ(records_.at("probes.0.rate"), "1 m^2/s from s.yaml:1:68");
  EXPECT_EQ(records_.at("schedule"), "[{solve: a}] from s.yaml:1:89");
  EXPECT_EQ(records_.at("title"), "\"a: b\" from s.yaml:1:110");
  EXPECT_EQ(records_.count("source"), 0U);
  EXPECT_EQ(records_.count("output.interval"), 0U) << "the section is off";
  EXPECT_EQ(records_.count("type"), 0U);
}

TEST_F(Materials, recorded_defaults_read_back) {
  read("permeability: 1 m^2", context_);
  records_.erase("limits.tolerance");
  std::string scene;
  for (const auto& [path, record] : records_) scene += path + ": " + record.substr(0, record.find(" from ")) + "\n";
  EXPECT_NO_THROW(read(scene)) << scene;
}

TEST(Spec, mistakes_of_the_program_are_logic_errors) {
  double a = 0, b = 0;
  std::string word = "neither";
  EXPECT_THROW(Spec("s", "").quantity("a", a, {}).quantity("a", b, {}), std::logic_error);
  EXPECT_THROW(Spec("s", "").quantity("a", a, {}).ignore("a"), std::logic_error);
  EXPECT_THROW(Spec("s", "").ignore("a").quantity("a", a, {}), std::logic_error);
  EXPECT_THROW(Spec("s", "").quantity("a", a, {.unit = "MPa"}), std::logic_error);
  EXPECT_THROW(Spec("s", "").quantity("a", a, {.unit = "nonsense"}), std::logic_error);
  EXPECT_THROW(Spec("s", "").quantity("a", a, {.range = positive()}), std::logic_error);
  EXPECT_NO_THROW(Spec("s", "").quantity("a", a, {.range = positive(), .required = true}));
  EXPECT_THROW(Spec("s", "").choice("a", word, {{"one", ""}, {"two", ""}}, {}), std::logic_error);
}

TEST(Spec, an_absent_section_with_required_parameters_is_left_alone) {
  double rate = 0;
  Spec spec("s", "");
  spec.section("well", Options::well(rate), {});
  EXPECT_NO_THROW(spec.read(parse_yaml("{}", "s.yaml"), {}));
  Spec strict("s", "");
  strict.section("well", Options::well(rate), {.required = true});
  EXPECT_EQ(input_error_of([&] { strict.read(parse_yaml("{}", "s.yaml"), {}); }),
            "s.yaml:1:1: 'well' is missing in the scene (s needs it) add 'well:'");
}

TEST(Range, contains_and_says_its_bounds) {
  EXPECT_EQ(Range{}.text(), "");
  EXPECT_EQ(positive().text(), "> 0");
  EXPECT_EQ(non_negative().text(), ">= 0");
  EXPECT_EQ(between(0, 1).text(), "from 0 to 1");
  EXPECT_EQ(strictly_between(0, 0.5).text(), "> 0 and < 0.5");
  EXPECT_FALSE(positive().contains(0));
  EXPECT_TRUE(non_negative().contains(0));
  EXPECT_TRUE(between(0, 1).contains(1));
  EXPECT_FALSE(strictly_between(0, 1).contains(1));
  EXPECT_FALSE(positive().contains(std::numeric_limits<double>::quiet_NaN()));
}

}  // namespace
}  // namespace sprekk
