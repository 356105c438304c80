// Formulas of the state: values, derivatives, units, jumps, and what messages say.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <array>
#include <cmath>

#include "framework/config/expression.hpp"
#include "framework/config/spec.hpp"
#include "framework/config/state.hpp"
#include "framework/config/units.hpp"
#include "tests/framework/config/messages.hpp"

namespace sprekk {
namespace {

using testing::HasSubstr;

const Origin here{"s.yaml", 3, 4};
const StateVariables variables = {{"slip", "m", "slip"}, {"sigma_n", "Pa", "normal stress"}};

Data formula(const std::string& text, const std::string& unit = "") {
  const ReadsFormula reads(&variables);
  return parse_data(text, unit, here, "p");
}

struct Value {
  double value;
  std::array<double, 2> by;
};
Value at(const Data& data, double slip, double sigma_n) {
  Value result{};
  result.value = value_at_state(data, {{0.3, -2.0}, 0, 5000}, variables, std::array{slip, sigma_n}, result.by);
  return result;
}

class Derivative : public testing::TestWithParam<const char*> {};

/// By differences of second order over a few steps, with the error that they leave.
TEST_P(Derivative, is_that_of_the_values) {
  const Data data = formula(GetParam());
  for (const double s : {0.013, 0.31, 0.74}) {
    const Value known = at(data, s, 0);
    constexpr double h = 1e-5;
    const double difference = (at(data, s + h, 0).value - at(data, s - h, 0).value) / (2 * h);
    EXPECT_NEAR(known.by[0], difference, 1e-6 * (1 + std::abs(difference)) * (1 + 1e-2 / (s * s))) << GetParam() << s;
    EXPECT_EQ(known.by[1], 0);
  }
}

// Arguments lie where every function has a derivative.
INSTANTIATE_TEST_SUITE_P(
    all, Derivative,
    testing::Values("sin(slip/m)", "cos(slip/m)", "tan(slip/m)", "asin(slip/m)", "acos(slip/m)", "atan(slip/m)",
                    "sinh(slip/m)", "cosh(slip/m)", "tanh(slip/m)", "asinh(slip/m)", "acosh(2 + slip/m)",
                    "atanh(slip/m)", "exp(slip/m)", "log(slip/m)", "log10(slip/m)", "sqrt(slip/m)", "abs(0.2 - slip/m)",
                    "erf(slip/m)", "erfc(slip/m)", "atan2(slip, 0.4 m)", "atan2(0.4 m, slip)", "(slip/m)^2",
                    "(slip/m)^3", "(slip/m)^4", "(slip/m)^5", "slip^2/m^2", "(slip/m)^-0.5", "2^(slip/m)",
                    "(slip/m)^(slip/m)", "pow(1 + slip/m, 2.5)", "min(0.2, slip/m)", "max(0.2, slip/m)",
                    "max(0.5, 0.1 + slip/m, 0.2)", "if(slip < 0.2 m, 0.2, slip/m)", "slip > 0.2 m ? slip/m : 0.2",
                    "-slip/m", "1 - 2*slip/m*3 + 4", "(3 - slip/m)*2/5", "1/(1 + slip/m)", "(1 + slip/m)/(2 - slip/m)",
                    "x*slip/m + t/day", "0.6 - min(1, slip/(0.3 m))*0.2"));

TEST(Formula, HasAFormulasOwnValueAndPiece) {
  const Data weakening = formula("max(0.3, 0.6 - slip/(1*mm))");
  EXPECT_NEAR(at(weakening, 1e-4, 0).value, 0.5, 1e-15);
  EXPECT_NEAR(at(weakening, 1e-4, 0).by[0], -1e3, 1e-12);
  EXPECT_EQ(at(weakening, 1e-3, 0).value, 0.3);
  EXPECT_EQ(at(weakening, 1e-3, 0).by[0], 0);
  const Value of_both = at(formula("slip*exp(-sigma_n/(20 MPa))", "m"), 0.5, 3e7);
  EXPECT_NEAR(of_both.by[0], std::exp(-1.5), 1e-15);
  EXPECT_NEAR(of_both.by[1], -0.5 * std::exp(-1.5) / 2e7, 1e-22);
  // A piece that is not taken has no say, though its value does not exist.
  EXPECT_EQ(at(formula("if(slip < 0.2 m, 0.2, 0.2 + sqrt(slip/m - 0.2))"), 0.1, 0).by[0], 0);
}

TEST(Formula, IsTheSumOfItsWindowsAndTheOneOfItsRegion) {
  EXPECT_EQ(variables_named(formula("sigma_n/(1 Pa) + x"), {}, variables), 2U);
  EXPECT_EQ(variables_named(formula("x"), {}, variables), 0U);
  EXPECT_THAT(runtime_error_of([] { formula("slip/m").at({}); }), HasSubstr("'slip/m' is a formula of the state"));
}

struct WrongFormula {
  const char *text, *unit, *message;
};
class Refused : public testing::TestWithParam<WrongFormula> {};
TEST_P(Refused, is_told_why) {
  const auto& [text, unit, message] = GetParam();
  EXPECT_THAT(input_error_of([&] { formula(text, unit); }), HasSubstr(message)) << text;
}
INSTANTIATE_TEST_SUITE_P(
    all, Refused,
    testing::Values(WrongFormula{"0.6 - slp/m", "", "unknown name in the expression '0.6 - slp/m': 'slp' (it is not"},
                    WrongFormula{"0.6 - slp/m", "", "did you mean 'slip'?"},
                    WrongFormula{"exp(-sigma_n/20)", "", "has another unit, or a term without one"},
                    WrongFormula{"0.6 - slip", "", "has another unit, or a term without one"},
                    WrongFormula{"slip*sigma_n", "Pa", "has another unit, or a term without one"},
                    WrongFormula{"slip + 1e-3", "m", "has another unit, or a term without one"},
                    WrongFormula{"if(slip < 1 mm, 0.6, 0.3)", "",
                                 "'p' jumps from 0.6 to 0.3 at slip = 0.001 m: 'if(slip < (1*mm), 0.6, 0.3)'"},
                    WrongFormula{"if(sigma_n > 5 MPa && slip > 2 mm, 0.6, 0.3)", "", "jumps from 0.3 to 0.6 at"},
                    WrongFormula{"floor(slip/m*100)", "", "jumps from 0 to 1 at slip = 0.01 m"},
                    WrongFormula{"0.6 + 0.1*sign(slip - 3 mm)", "", "at slip = 0.003 m"}));

TEST(Formula, MayJumpInPlaceAndTimeAndBendAnywhere) {
  for (const char* text : {"if(t < 6 h, 0.6, 0.3) + slip/m", "if(slip < 1 mm, 0.6, 0.6 - (slip - 1 mm)/m)",
                           "abs(slip - 2 mm)/m", "min(slip/m, 0.5)", "if(x > 2, 0.1, 0.2)*slip/m"})
    EXPECT_NO_THROW(formula(text)) << text;
}

TEST(Formula, TellsTheStateInWhichItHasNoValue) {
  EXPECT_THAT(
      runtime_error_of([] { at(formula("log(1 - slip/m)"), 2, 1e6); }),
      HasSubstr("s.yaml:3:4: the expression 'log(1 - slip/m)' has no finite value at x = 0.3, y = -2, t = 5000, "
                "slip = 2 m (it is no number"));
  EXPECT_THAT(runtime_error_of([] { at(formula("sqrt(slip/m)"), 0, 0); }), HasSubstr("has no finite derivative at"));
  Data friction;
  Spec spec("test", "A test.");
  spec.data("friction", friction, {.range = non_negative(), .doc = "Friction."});
  may_be_formula(spec.name(), "friction", variables);
  Node node;
  node.kind = Node::Kind::map;
  Node value;
  value.kind = Node::Kind::scalar;
  value.scalar = "0.6 - slip/m";
  node.entries.push_back({"friction", here, value});
  spec.read(node, {});
  EXPECT_NEAR(at(friction, 0.1, 0).value, 0.5, 1e-15);
  EXPECT_THAT(
      runtime_error_of([&] { at(friction, 0.7, 0); }),
      testing::AllOf(HasSubstr("'friction' is -0.09999"), HasSubstr("slip = 0.7 m"), HasSubstr("it must be >= 0")));
  EXPECT_THAT(explain(spec), HasSubstr("A formula may name slip (slip, m), sigma_n (normal stress, Pa)."));
  EXPECT_THAT(json_schema(spec), HasSubstr("A formula may name slip"));
  EXPECT_THAT(reference_page(spec), HasSubstr("A formula may name slip"));
}

TEST(UnitOfData, FollowsFromItsTerms) {
  const auto unit = [](const std::string& text) { return unit_of_data(text, here, "p", variables); };
  EXPECT_EQ(unit("slip"), "m");
  EXPECT_EQ(unit("sigma_n*slip"), "Pa*m");
  EXPECT_EQ(unit("sqrt(slip^2)/m + 3"), "");
  EXPECT_EQ(unit("max(0, sigma_n - 3 MPa)"), "Pa");
  EXPECT_EQ(unit("(slip/m) MPa"), "Pa");
  EXPECT_EQ(unit("1"), "");
  EXPECT_EQ(unit("5 kg/m^3"), "m^-3*kg^1");
  EXPECT_TRUE(have_one_dimension(unit("5 kg/m^3*sqrt(slip)"), "kg*m^-2.5"));
  EXPECT_EQ(unit("slip*(1 + t/day)"), "m");
  EXPECT_THROW(unit("slip + sigma_n"), InputError);
  EXPECT_THROW(unit("slip + 1"), InputError);
}

TEST(Names, AreWholeWords) {
  EXPECT_TRUE(names("2*slip + 1", "slip"));
  EXPECT_FALSE(names("2*slip_rate + aslip + slip2", "slip"));
  EXPECT_TRUE(is_free_name("work", variables));
  for (const char* taken : {"slip", "x", "t", "pi", "mm", "sqrt", "max"}) EXPECT_FALSE(is_free_name(taken, variables));
}

}  // namespace
}  // namespace sprekk
