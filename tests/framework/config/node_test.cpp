#include "framework/config/node.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "framework/config/yaml/parse_yaml.hpp"
#include "tests/framework/config/messages.hpp"

namespace sprekk {
namespace {

using testing::ElementsAre;
using testing::HasSubstr;

TEST(ParseYaml, knows_where_everything_stands) {
  const Node root =
      parse_yaml("components:\n  pore:\n    type: matrix_flow/mpfa\n    sides: [a, {b: 1 m}]\n", "s.yaml");
  const Node& pore = *root.find("components")->find("pore");
  EXPECT_EQ(pore.path, "components.pore");
  EXPECT_THAT(pore.keys(), ElementsAre("type", "sides"));
  EXPECT_EQ(pore.find("type")->scalar, "matrix_flow/mpfa");
  EXPECT_EQ(pore.find("type")->origin.text(), "s.yaml:3:11");
  EXPECT_EQ(pore.entries[1].origin.text(), "s.yaml:4:5");
  const Node& b = *pore.find("sides")->items[1].find("b");
  EXPECT_EQ(b.path, "components.pore.sides.1.b");
  EXPECT_EQ(b.origin.text(), "s.yaml:4:20");
  EXPECT_EQ(pore.find("nothing"), nullptr);
}

TEST(ParseYaml, tells_null_from_quoted_null) {
  const Node root = parse_yaml("a:\nb: ~\nc: 'null'\nd: \"\"\n", "s.yaml");
  EXPECT_TRUE(root.find("a")->is_null());
  EXPECT_EQ(root.find("a")->origin.text(), "s.yaml:1:1");
  EXPECT_TRUE(root.find("b")->is_null());
  EXPECT_EQ(root.find("c")->scalar, "null");
  EXPECT_TRUE(root.find("d")->is_scalar());
}

TEST(ParseYaml, expands_aliases_and_merge_keys) {
  const Node root = parse_yaml("base: &b {x: 1, y: 2}\nuse: {<<: *b, y: 3}\ncopy: *b\n", "s.yaml");
  EXPECT_EQ(root.find("use")->text(), "{y: 3, x: 1}");
  EXPECT_EQ(root.find("copy")->text(), "{x: 1, y: 2}");
  EXPECT_EQ(root.find("copy")->find("x")->path, "copy.x");
}

TEST(ParseYaml, accepts_a_byte_order_mark_and_windows_lines) {
  EXPECT_EQ(parse_yaml("\xEF\xBB\xBFname: a\r\nvalue: b\r\n", "s.yaml").text(), "{name: a, value: b}");
}

TEST(NodeText, is_yaml_that_reads_back) {
  const std::string text =
      "{a: [1 m, -2.5e-3, \"-\", ~, \"null\"], \"b, c\": \"x: y\", d: \"say \\\"hi\\\"\", e: [], f: {}}";
  const Node node = parse_yaml(text, "s.yaml");
  EXPECT_EQ(node.text(), text.substr(0, text.find("f: {}")) + "f: {}}");
  EXPECT_EQ(parse_yaml(node.text(), "s.yaml").text(), node.text());
}

TEST(YamlScalar, quotes_what_yaml_would_misread) {
  for (const std::string text : {"x <= 1 ? 2 : 3", "...", "- a", "a #b", "null", "", "a: b", "{", "*a", "%Y", "b?",
                                 "c:", "tab\there", "-", "--- x", "say \"hi\"", "back\\slash", " a ", "two\nlines"}) {
    EXPECT_EQ(parse_yaml("{k: " + yaml_scalar(text) + "}", "s.yaml").find("k")->scalar, text);
  }
  EXPECT_EQ(yaml_scalar("-2.5 m^2/s"), "-2.5 m^2/s");
}

struct Malformed {
  const char* name;
  std::string text;
  const char* message;
};

class MalformedYaml : public testing::TestWithParam<Malformed> {};

TEST_P(MalformedYaml, is_refused) {
  EXPECT_THAT(input_error_of([] { parse_yaml(GetParam().text, "s.yaml"); }), HasSubstr(GetParam().message));
}

std::string nested(int levels) { return std::string(levels, '[') + std::string(levels, ']'); }

std::string bomb() {
  std::string text = "a0: &a0 [x, x, x, x, x, x, x, x, x, x]\n";
  for (int i = 1; i < 10; ++i) {
    const std::string alias = "*a" + std::to_string(i - 1);
    text += "a" + std::to_string(i) + ": &a" + std::to_string(i) + " [" + alias;
    for (int j = 1; j < 10; ++j) text += ", " + alias;
    text += "]\n";
  }
  return text;
}

std::string anchors_in_anchors() {
  std::string text;
  for (int i = 0; i < 60; ++i) text += "&a" + std::to_string(i) + " [";
  for (int i = 0; i < 150'000; ++i) text += "1,";
  return text + std::string(60, ']');
}

INSTANTIATE_TEST_SUITE_P(
    all, MalformedYaml,
    testing::Values(
        Malformed{"duplicate", "a: 1\nb:\n  c: 1\n  c: 2\n",
                  "s.yaml:4:3: duplicate key 'c' (it stands already at s.yaml:3:3) keep one of them"},
        Malformed{"bracket", "a: [1, 2\nb: 3\n", "s.yaml:1:4: the '[' is never closed ("},
        Malformed{"tab", "a:\n\tb: 1\n", "s.yaml:2:1: malformed YAML (a tab stands in the indentation) use spaces"},
        Malformed{"anchor", "a: *nowhere\n", "s.yaml:1:4: malformed YAML ("},
        Malformed{"itself", "a: &a [1, *a]\n", "s.yaml:1:11: an alias stands inside the value that it repeats"},
        Malformed{"documents", "a: 1\n---\nb: 2\n", "a second YAML document begins here"},
        Malformed{"tag", "a: !!binary aGk=\n", "unexpected YAML tag 'tag:yaml.org,2002:binary'"},
        Malformed{"list_as_key", "[1, 2]: 3\n", "s.yaml:1:1: a key of a map must be a name"},
        Malformed{"empty_key", "{: 3}\n", "a key of a map must be a name"},
        Malformed{"merge_scalar", "<<: 3\n", "s.yaml:1:5: '<<' needs a map to merge"},
        Malformed{"nul", std::string("a: 1\nb: \0\n", 10), "s.yaml:2: not a text file (it has a control byte here)"},
        Malformed{"escape", "a: \x1b[31m\n", "s.yaml:1: not a text file (it has a control byte here)"},
        Malformed{"latin1", "a: gr\xfcn\n", "s.yaml:1: not a text file (it has a byte here that is not UTF-8)"},
        Malformed{"deep", nested(65), "s.yaml:1:65: the scene is nested too deeply (at most 64 levels)"},
        Malformed{"very_deep", nested(100'000), "the scene is nested too deeply"},
        Malformed{"bomb", bomb(), "the scene is too large (it has more than 200000 values once aliases are expanded)"},
        Malformed{"anchors", anchors_in_anchors(), "the scene is too large"}),
    [](const auto& info) { return std::string(info.param.name); });

TEST(ParseYaml, accepts_what_is_just_within_the_limits) {
  EXPECT_NO_THROW(parse_yaml(nested(64), "s.yaml"));
  std::string list = "[0";
  for (int i = 1; i < 199'999; ++i) list += ",0";
  EXPECT_EQ(parse_yaml(list + "]", "s.yaml").items.size(), 199'999U);
}

}  // namespace
}  // namespace sprekk
