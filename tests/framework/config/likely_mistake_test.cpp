// Mistakes in YAML that the parser does not name.
#include "framework/config/yaml/likely_mistake.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "framework/config/yaml/parse_yaml.hpp"
#include "tests/framework/config/messages.hpp"

namespace sprekk {
namespace {

using testing::HasSubstr;

std::string error(const std::string& text) {
  return input_error_of([&] { parse_yaml(text, "s.yaml"); });
}

TEST(LikelyMistake, NamesAQuotationMarkThatIsNeverClosed) {
  EXPECT_EQ(
      error("name: \"abc\ngeometry:\n  box: {x: [0 m, 1 m], y: [0 m, 1 m]}\n"),
      "s.yaml:1:7: the quotation mark \" is never closed (the text ends in it) close it on its line, or remove it");
  EXPECT_EQ(
      error("a: 1\nb: {c: 'x}\n"),
      "s.yaml:2:8: the quotation mark ' is never closed (the text ends in it) close it on its line, or remove it");
  // The next quotation mark closes it, and what follows makes no sense.
  EXPECT_EQ(error("name: \"abc\nwhen: \"t > 1\"\n"),
            "s.yaml:1:7: the quotation mark \" is not closed on its line (the next one, in line 2, ends the text that "
            "begins here) close it, or remove it");
}

TEST(LikelyMistake, NamesTheLineThatIsIndentedLess) {
  EXPECT_EQ(
      error("components:\n    pore:\n        type: a\n      storage: 1\n    rock:\n        type: b\n"),
      "s.yaml:4:7: the line is indented by 6 spaces (the lines above, to which it could belong, by 4 or 8) indent it "
      "as those that it belongs to");
  EXPECT_EQ(
      error("schedule:\n  - iterate:\n      steps: a\n     until: b\n"),
      "s.yaml:4:6: the line is indented by 5 spaces (the lines above, to which it could belong, by 4 or 6) indent it "
      "as those that it belongs to");
  EXPECT_THAT(error("a:\n   b: 1\n c: 2\n"), HasSubstr("s.yaml:3:2: the line is indented by 1 space ("));
}

TEST(LikelyMistake, NamesABracketThatIsNotClosed) {
  EXPECT_EQ(error("a: {x: [0 m, 1 m}\nb: 1\n"),
            "s.yaml:1:17: a '}' closes the '[' (which stands at s.yaml:1:8) write ']'");
  EXPECT_EQ(error("a: 1\nbox: {x: [0 m, 1 m], y: 2\nb: 1\n"),
            "s.yaml:2:6: the '{' is never closed (the text ends in it) write '}' where it ends");
}

TEST(LikelyMistake, NamesTheLineThatHasNoKey) {
  EXPECT_EQ(error("a:\n  young_modulus:20 GPa  # stiff\n\n  b: 1\n"),
            "s.yaml:2:3: 'young_modulus:20 GPa' is no key with a value (no blank stands behind its ':') write "
            "'young_modulus: 20 GPa'");
  EXPECT_EQ(error("a:\n  b: 1\n  c = 0.25\n  d: 1\n"),
            "s.yaml:3:3: 'c = 0.25' is no key with a value (':' stands between the two, not '=') write 'c: 0.25'");
  EXPECT_THAT(error("a:\n  // text\n  d: 1\n"), HasSubstr("s.yaml:2:3: '// text' is no key with a value (comments"));
}

TEST(LikelyMistake, NamesTheLineThatIsDeeperThanAValue) {
  EXPECT_EQ(error("a:\n  b:\n    c: 1\n  d: 5 MPa\n    e: 2\n"),
            "s.yaml:5:5: the line is indented by 4 spaces (the line above it, by 2, has its value already) indent both "
            "alike, or move one of them");
}

TEST(LikelyMistake, NamesTheListAmongKeys) {
  EXPECT_EQ(error("a:\n  - name: b\n    c: 1\n  d:\n    e: 1\n"),
            "s.yaml:2:3: '- ' begins a list (line 4, as deep as it, has none: it is a key of a map) write '- ' before "
            "all of them, or before none");
}

TEST(LikelyMistake, NamesATab) {
  EXPECT_EQ(error("a:\n\tb: 1\n"), "s.yaml:2:1: malformed YAML (a tab stands in the indentation) use spaces");
}

TEST(LikelyMistake, IsNotSeenInWhatIsRight) {
  for (const char* text :
       {"a: it's 5 o'clock\nb: 1\n", "a: \"x # [ y\"  # { comment '\nb: [1, {c: 'it''s'}]\n",
        "a:\n  - - 1\n    - 2\n  - b: 1\n    c: 2\nd: 3\n", "a: |\n   text [ '\n  more\nb: 1\n",
        "- a: 1\n  b:\n    - c\n- d\n", "a: \"two\n  lines\"\nb: 1\n", "a: {b: 1,\n  c: [2,\n3]}\nd: 4\n", ""})
    EXPECT_FALSE(likely_mistake(text, "s.yaml")) << text << likely_mistake(text, "s.yaml")->what();
}

TEST(ParseYaml, NamesASpaceThatIsNone) {
  EXPECT_EQ(error("a: 5\u00A0MPa\n"),
            "s.yaml:1:4: '5\u00A0MPa' has a non-breaking space (behind its character 1; it looks like a space, and is "
            "another "
            "character) type a space instead");
  EXPECT_THAT(error("a:\n\u00A0 b: 1\n"), HasSubstr("has a non-breaking space"));
  EXPECT_NO_THROW(parse_yaml("a: 5 MPa  # 5\u00A0MPa\n", "s.yaml"));
}

}  // namespace
}  // namespace sprekk
