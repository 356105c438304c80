// Laws that are registered by name: their parameters, and messages for wrong ones.
#include "framework/scene/law_registry.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>

#include "framework/config/yaml/parse_yaml.hpp"

namespace sprekk {
namespace {

struct Law {
  virtual ~Law() = default;
  virtual double at(double x) const = 0;
};

struct Power : Law {
  double exponent, factor;
  Power(double exponent, double factor) : exponent(exponent), factor(factor) {}
  double at(double x) const override { return factor * std::pow(x, exponent); }
};

struct PowerOptions {
  double exponent = 0;
  Spec spec() {
    Spec spec("power", "factor x^exponent");
    spec.quantity("exponent", exponent, {.doc = "The exponent.", .required = true});
    return spec;
  }
  std::unique_ptr<Law> build(const double& factor) const { return std::make_unique<Power>(exponent, factor); }
};

struct SquareOptions {
  Spec spec() { return Spec("square", "factor x^2"); }
  std::unique_ptr<Law> build(const double& factor) const { return std::make_unique<Power>(2, factor); }
};

struct Options {
  std::string type = "none";
  LawChoice<Law, double> registered;
  explicit Options(const LawRegistry<Law, double>& laws, const std::string& text) {
    Spec spec("law", "A law.");
    std::vector<std::pair<std::string, std::string>> names = {{"none", "nothing"}};
    for (const auto& law : laws.types()) names.emplace_back(law.name, law.doc);
    spec.choice("type", type, names, {.doc = "Which."});
    registered.add_sections(spec, laws);
    spec.check([this](const Node& node) { registered.check(node, type, "type"); });
    spec.read(parse_yaml(text, "scene.yaml"), {});
  }
};

class Laws : public ::testing::Test {
 protected:
  Laws() {
    RegisterLaw<PowerOptions, Law, double>(laws_, "power");
    RegisterLaw<SquareOptions, Law, double>(laws_, "square");
  }
  std::string refusal(const std::string& text) const {
    try {
      Options(laws_, text);
    } catch (const InputError& error) {
      return error.what();
    }
    return "";
  }
  LawRegistry<Law, double> laws_;
};

TEST_F(Laws, AreBuiltWithTheirParameters) {
  const Options power(laws_, "{type: power, power: {exponent: 3}}"), square(laws_, "{type: square}");
  EXPECT_EQ(power.registered.build(power.type, 5.0)->at(2), 40);
  EXPECT_EQ(square.registered.build(square.type, 5.0)->at(2), 20);
  EXPECT_EQ(square.registered.build("none", 5.0), nullptr);
  const Options copy = power;  // of parameters that have been read
  EXPECT_EQ(copy.registered.build(copy.type, 1.0)->at(2), 8);
  const Options other(laws_, "{type: power, power: {exponent: 1}}");
  EXPECT_EQ(power.registered.build(power.type, 1.0)->at(2), 8) << "two laws of one type share parameters";
}

TEST_F(Laws, TellWhatIsWrong) {
  EXPECT_THAT(refusal("{type: power}"), ::testing::HasSubstr("'power' is missing"));
  EXPECT_THAT(refusal("{type: square, power: {exponent: 3}}"),
              ::testing::HasSubstr("scene.yaml:1:23: 'power' has no effect"));
  EXPECT_THAT(refusal("{type: power, power: {exponent: 3 m}}"), ::testing::HasSubstr("exponent"));
  EXPECT_THAT(refusal("{type: powr}"), ::testing::HasSubstr("'power'"));
  EXPECT_THROW((RegisterLaw<SquareOptions, Law, double>(laws_, "square")), std::logic_error);
}

}  // namespace
}  // namespace sprekk
