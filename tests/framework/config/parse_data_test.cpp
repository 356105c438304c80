// Expressions and the units behind them.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <numbers>
#include <thread>

#include "framework/config/units.hpp"
#include "tests/framework/config/messages.hpp"

namespace sprekk {
namespace {

using testing::HasSubstr;

const Origin here{"s.yaml", 3, 4};
const Place place{{0.3, -2.0}, 0, 5000};
constexpr double pi = std::numbers::pi;

struct Expression {
  const char* text;
  const char* unit;
  double value;  ///< at x = 0.3, y = -2, t = 5000
};

class ParseExpression : public testing::TestWithParam<Expression> {};

TEST_P(ParseExpression, has_its_value) {
  const auto& [text, unit, value] = GetParam();
  EXPECT_NEAR(parse_data(text, unit, here).at(place), value, 4e-15 * std::abs(value)) << text;
}

INSTANTIATE_TEST_SUITE_P(
    all, ParseExpression,
    testing::Values(
        Expression{"20 MPa", "Pa", 2e7}, Expression{"20MPa", "Pa", 2e7}, Expression{"5 %", "", 0.05},
        Expression{"-3", "m", -3}, Expression{"x", "m", 0.3}, Expression{"x km", "m", 300},
        Expression{"(1 + 0.1*sin(pi*x)) MPa", "Pa", 1e6 * (1 + 0.1 * std::sin(pi * 0.3))},
        Expression{"(x)MPa", "Pa", 3e5}, Expression{"sin(x) MPa", "Pa", 1e6 * std::sin(0.3)},
        Expression{"if(t < 6*h, 0, 5e-9) m^2/s", "m^2/s", 0}, Expression{"if(t < 1*h, 0, 5e-9) m^2/s", "m^2/s", 5e-9},
        Expression{"if(t < 1 h, 0, 5e-9 m^2/s)", "m^2/s", 5e-9}, Expression{"if(t < 1*h, 0, 5) l/s", "m^3/s", 5e-3},
        Expression{"2*3", "", 6}, Expression{"2 * x", "", 0.6}, Expression{"x*y + t", "", 4999.4},
        Expression{"-x^2", "", -0.09}, Expression{"2^3^2", "", 512}, Expression{"2^-1", "", 0.5},
        Expression{"10-4-3", "", 3}, Expression{"2*x/3", "", 0.2}, Expression{"cos(x)", "", std::cos(0.3)},
        Expression{"tan(x)", "", std::tan(0.3)}, Expression{"exp(x)", "", std::exp(0.3)},
        Expression{"log(x)", "", std::log(0.3)}, Expression{"log10(x)", "", std::log10(0.3)},
        Expression{"sqrt(x)", "", std::sqrt(0.3)}, Expression{"abs(y)", "", 2},
        Expression{"tanh(x)", "", std::tanh(0.3)}, Expression{"sinh(x)", "", std::sinh(0.3)},
        Expression{"cosh(x)", "", std::cosh(0.3)}, Expression{"asin(x)", "", std::asin(0.3)},
        Expression{"acos(x)", "", std::acos(0.3)}, Expression{"atan(x)", "", std::atan(0.3)},
        Expression{"asinh(x)", "", std::asinh(0.3)}, Expression{"acosh(2 + x)", "", std::acosh(2.3)},
        Expression{"atanh(x)", "", std::atanh(0.3)}, Expression{"atan2(x, y)", "", std::atan2(0.3, -2)},
        Expression{"erf(x)", "", std::erf(0.3)}, Expression{"erfc(x)", "", std::erfc(0.3)},
        Expression{"pow(x, 3)", "", 0.027}, Expression{"sign(y)", "", -1}, Expression{"floor(y + 0.5)", "", -2},
        Expression{"ceil(x)", "", 1}, Expression{"min(x, y)", "", -2}, Expression{"max(x, y, 7)", "", 7},
        Expression{"2*min", "s", 120}, Expression{"min(2*min, h)", "s", 120}, Expression{"e", "", std::numbers::e},
        Expression{"1e3*x", "", 300}, Expression{"t/day", "", 5000. / 86400},
        Expression{"3*MPa + 2*kPa", "Pa", 3.002e6}, Expression{"sin(30*deg)", "", 0.5},
        Expression{"x < 1 && y < 0", "", 1}, Expression{"x > 1 || y > 0", "", 0}, Expression{"x == 0.3", "", 1},
        Expression{"x != 0.3", "", 0}, Expression{"x <= 0.3 ? 4 : 5", "", 4}, Expression{"x >= 0.4", "", 0},
        Expression{"if(x < 0, log(x), 2)", "", 2}));

TEST(ParseData, knows_what_it_depends_on) {
  const auto data = [](const char* text) { return parse_data(text, "", here); };
  EXPECT_TRUE(data("2*pi").is_constant());
  EXPECT_TRUE(data("0*3").is_zero());
  EXPECT_TRUE(data("x").depends_on_space());
  EXPECT_FALSE(data("x").depends_on_time());
  EXPECT_TRUE(data("max(0, t)").depends_on_time());
  EXPECT_FALSE(data("max(0, t)").depends_on_space());
  EXPECT_TRUE(data("exp(y)*t").depends_on_time());
  EXPECT_TRUE(data("exp(y)*t").depends_on_space());
}

TEST(ParseData, can_be_evaluated_by_several_threads) {
  const Data data = parse_data("x*x + t", "", here);
  std::vector<std::thread> threads;
  std::vector<int> mistakes(4, 0);
  for (int k = 0; k < 4; ++k) {
    threads.emplace_back([&, k] {
      for (int i = 0; i < 20'000; ++i) mistakes[k] += data.at({{k, 0}, 0, 1.0 * i}) == k * k + i ? 0 : 1;
    });
  }
  for (std::thread& thread : threads) thread.join();
  EXPECT_THAT(mistakes, testing::Each(0));
}

TEST(ParseData, says_where_an_expression_has_no_value) {
  const Data data = parse_data("log(x)", "", here);
  EXPECT_THAT(
      runtime_error_of([&] {
        data.at({{-1, 2}, 0, 3});
      }),
      HasSubstr("s.yaml:3:4: the expression 'log(x)' has no finite value at x = -1, y = 2, t = 3 (it is no number"));
  EXPECT_THAT(runtime_error_of([] {
                parse_data("1/x", "", here).at({{0, 2}, 0, 3});
              }),
              HasSubstr("the expression '1/x' has no finite value at x = 0, y = 2, t = 3 (it is infinite"));
}

struct Wrong {
  const char* text;
  const char* unit;
  const char* message;
};

class WrongDatum : public testing::TestWithParam<Wrong> {};

TEST_P(WrongDatum, is_refused) {
  const auto& [text, unit, message] = GetParam();
  EXPECT_THAT(input_error_of([&] { parse_data(text, unit, here, "p"); }), HasSubstr(message));
}

INSTANTIATE_TEST_SUITE_P(
    all, WrongDatum,
    testing::Values(Wrong{"", "", "s.yaml:3:4: 'p' is empty"}, Wrong{"40 GPa", "m^2", "has the dimension of pressure"},
                    Wrong{"sin(z)", "",
                          "s.yaml:3:4: unknown name in the expression 'sin(z)': 'z' (it is not one of: x, y, t, "},
                    Wrong{"sn(x)", "", "did you mean 'sin'?"}, Wrong{"sin(x", "", "malformed expression 'sin(x' ("},
                    Wrong{"x)", "", "malformed expression"}, Wrong{"x +", "", "malformed expression"},
                    Wrong{"x = 3", "", "('=' assigns) compare with '=='"}, Wrong{"1*2, 3", "", "it has several values"},
                    Wrong{"if(x, 1)", "", "malformed expression"}, Wrong{"pow(x)", "", "malformed expression"},
                    Wrong{"1/0", "", "'1/0' has no finite value (it is infinite"},
                    Wrong{"sqrt(-1)", "", "has no finite value"}, Wrong{"nan", "", "is not finite"},
                    Wrong{"inf", "", "is not finite"},
                    Wrong{"2 + x m", "m",
                          "(it is not clear what the unit 'm' belongs to) write '(2 + x) m' or multiply by the unit"},
                    Wrong{"(x + 2) s", "m", "'(x + 2) s' for 'p' has the dimension of time (needed is length, in m)"},
                    Wrong{"(x + 2) metre", "m", "unknown unit 'metre'"}, Wrong{"\"x\"", "", "malformed expression"},
                    Wrong{"hello world", "", "unknown unit 'world'"}));

struct Bare {
  const char* text;
  const char* unit;
  bool is_refused;
};

void PrintTo(const Bare& bare, std::ostream* text) { *text << bare.text << " in " << bare.unit; }

class BareExpression : public testing::TestWithParam<Bare> {};

TEST_P(BareExpression, needs_its_unit_as_a_number_does) {
  const auto& [text, unit, is_refused] = GetParam();
  if (is_refused)
    EXPECT_THAT(input_error_of([&] { parse_data(text, unit, here, "p"); }),
                testing::AnyOf(HasSubstr(std::string("'") + text + "' for 'p' has no unit (needed is "),
                               HasSubstr("for 'p' has another unit, or a term without one (needed is ")));
  else
    EXPECT_NO_THROW(parse_data(text, unit, here, "p"));
}

INSTANTIATE_TEST_SUITE_P(
    all, BareExpression,
    testing::Values(
        Bare{"2*10", "Pa", true}, Bare{"(2*10)", "Pa", true}, Bare{"(20e6)", "Pa", true}, Bare{"-(3)", "Pa", true},
        Bare{"1e6 + 1e6", "Pa*s", true}, Bare{"2*10", "m^2", true}, Bare{"2*10", "m^3", true},
        Bare{"2*10", "1/Pa", true}, Bare{"2*10", "s", true}, Bare{"2*10", "m/s", true}, Bare{"2*10", "m^2/s", true},
        Bare{"2*10", "1/s", true}, Bare{"2*10", "N/m^3", true}, Bare{"2*10", "m/s^2", true},
        Bare{"2*10", "Pa*m^0.5", true}, Bare{"pi/4", "rad", true}, Bare{"max(1, 2)", "m/(Pa*s)", true},
        Bare{"sin(30*deg)", "Pa", true}, Bare{"2*h/h", "Pa", true}, Bare{"5*MPa + 3", "Pa", true},
        Bare{"5*MPa*s", "Pa", true}, Bare{"5*s", "Pa", true}, Bare{"1e-6*m", "m^2", true},
        Bare{"2*10*min(1, 2)", "s", true},  // min is a function here
        // What depends on x, y and t needs its unit as well.
        Bare{"9810*(100-y)*1e-6", "Pa", true}, Bare{"1e4*x", "Pa", true}, Bare{"1e-6*(1 + 0.1*t)", "m^2/s", true},
        Bare{"x <= 0.3 ? 4 : 5", "Pa", true}, Bare{"if(t < 6*h, 0, 5e-9)", "m^2/s", true},
        Bare{"5*MPa + 9810*(100 - y)", "Pa", true}, Bare{"2 MPa + 3", "Pa", true}, Bare{"3 MPa*y", "Pa/m", true},
        Bare{"0.6*MPa", "", true}, Bare{"(5*MPa)", "m", true}, Bare{"sin(x) + 2*day", "", true},
        // x and y as lengths or as plain numbers, and t as a time or as a plain number.
        Bare{"x*y", "m^2", false}, Bare{"x/t", "m/s", false}, Bare{"9810 Pa/m*(100 m - y)", "Pa", false},
        Bare{"2*MPa*sin(pi*x)", "Pa", false}, Bare{"2 MPa*(1 + t/day)", "Pa", false},
        Bare{"2 MPa*(x + t/day)", "Pa", false}, Bare{"5 MPa + 2 bar", "Pa", false}, Bare{"0*y", "Pa", false},
        Bare{"max(2 MPa, 3 bar)", "Pa", false}, Bare{"0.7*max(0, 1 - t/(4 day))", "", false},
        Bare{"t < 12 h", "", false}, Bare{"t < 12 h && x > 3 km", "", false}, Bare{"5 km + 3*x", "m", false},
        Bare{"(1 + 0.1*sin(2*pi*t/day)) m^2/s", "m^2/s", false},
        // A plain number is one, a length is in m, and 0 is 0.
        Bare{"2*10", "", false}, Bare{"2*10", "m", false}, Bare{"0.1*x", "m", false}, Bare{"2 - 2", "Pa", false},
        Bare{"0*3", "m^2/s", false}, Bare{"(2*10) Pa", "Pa", false}, Bare{"(2*10) MPa", "Pa", false},
        Bare{"2*10*MPa", "Pa", false}, Bare{"5*MPa + 2*bar", "Pa", false}, Bare{"2*10*m^2", "m^2", false},
        Bare{"sqrt(4*m^4)", "m^2", false}, Bare{"1000*kg*9.81*m/s^2*3/m^2", "Pa", false},
        Bare{"0.7*MPa*m^0.5", "Pa*m^0.5", false}, Bare{"2*10*sin(30*deg)*MPa", "Pa", false},
        Bare{"30*deg + 5*deg", "rad", false}, Bare{"2*min", "s", false}, Bare{"1/(2*GPa)", "1/Pa", false},
        Bare{"5*MPa + 1e4*Pa/m*(50*m - y)", "Pa", false}));

struct InUnits {
  const char* text;
  const char* unit;
  double value;  ///< at x = 0.3, y = -2, t = 5000
};

/// A unit behind a number multiplies it, also inside of an expression.
class UnitsInside : public testing::TestWithParam<InUnits> {};

TEST_P(UnitsInside, MultiplyTheNumberBeforeThem) {
  const auto& [text, unit, value] = GetParam();
  EXPECT_NEAR(parse_data(text, unit, here).at(place), value, 4e-15 * std::abs(value)) << text;
}

INSTANTIATE_TEST_SUITE_P(
    all, UnitsInside,
    testing::Values(InUnits{"t < 12 h", "", 1}, InUnits{"t < 1 h", "", 0}, InUnits{"t > 1h && t < 2h", "", 1},
                    InUnits{"t < 5e-1 day", "", 1}, InUnits{"9810 Pa/m*(100 m - y)", "Pa", 9810.0 * 102},
                    InUnits{"5 MPa - 2 bar", "Pa", 4.8e6}, InUnits{"10 mPa*s", "Pa*s", 0.01},
                    InUnits{"2*10 MPa", "Pa", 2e7}, InUnits{"1/(2 GPa)", "1/Pa", 5e-10},
                    InUnits{"1/2 GPa", "1/Pa", 5e-10}, InUnits{"3*1e-10 1/Pa", "1/Pa", 3e-10},
                    InUnits{"2 m^2*x", "m^3", 0.6}, InUnits{"4 m^(1/2)*2", "m^0.5", 8}, InUnits{"sin(30 deg)", "", 0.5},
                    InUnits{"sin(30 °)", "", 0.5}, InUnits{"50 %*x", "", 0.15}, InUnits{"2 µm*3", "m", 6e-6},
                    InUnits{"min(2 min, 1 h)", "s", 120}, InUnits{"1 + 2 h*t/(1 h*1 s)", "", 10001},
                    InUnits{"3 W/(m*K)*2", "W/(m*K)", 6}, InUnits{"x + 2 m", "m", 2.3}));

TEST(ParseData, RefusesAUnitBehindAnExpressionThatHasOne) {
  EXPECT_EQ(
      input_error_of([] { parse_data("(2 MPa + 3*MPa) MPa", "Pa", here, "p"); }),
      "s.yaml:3:4: '(2 MPa + 3*MPa) MPa' for 'p' has units twice (the unit 'MPa' behind the expression multiplies "
      "those inside) keep one of them");
}

TEST(ParseData, NamesTheMistakeInANumber) {
  const auto error = [](const char* text) { return input_error_of([&] { parse_data(text, "m^2", here, "k"); }); };
  EXPECT_EQ(error("1d-17 m^2"),
            "s.yaml:3:4: '1d-17 m^2' for 'k' has no number that can be read (powers of ten are written with 'e') write "
            "'1e-17 m^2'");
  EXPECT_THAT(error("2.5D+3*x m^2"), HasSubstr("write '2.5e+3*x m^2'"));
  EXPECT_THAT(error("\u22125 m^2"), HasSubstr("has a minus sign that is no '-'"));
  EXPECT_THAT(error("1,5 m^2"), HasSubstr("has a decimal comma write decimals with a point"));
  EXPECT_NO_THROW(parse_data("2 d", "s", here, "p"));
}

TEST(ParseData, SuggestsTheUnitThatIsMeant) {
  const auto error = [](const char* text) { return input_error_of([&] { parse_data(text, "s", here, "p"); }); };
  EXPECT_THAT(error("3 yr"), HasSubstr("unknown unit 'yr' in '3 yr' for 'p'"));
  EXPECT_THAT(error("3 yr"), HasSubstr("did you mean 'year'?"));
  EXPECT_THAT(error("3 hours"), HasSubstr("did you mean 'h'?"));
  EXPECT_THAT(input_error_of([] { parse_data("t < 12 hours", "", here, "when"); }),
              testing::AllOf(HasSubstr("unknown unit 'hours'"), HasSubstr("did you mean 'h'?")));
}

TEST(ParseData, says_how_to_give_an_expression_its_unit) {
  EXPECT_EQ(
      input_error_of([] { parse_data("2*10", "Pa", here, "p"); }),
      "s.yaml:3:4: '2*10' for 'p' has no unit (needed is pressure, in Pa or another unit of it) write '(2*10) Pa', "
      "if that is what it is");
  EXPECT_THAT(input_error_of([] { parse_data("pi/4", "rad", here, "p"); }), HasSubstr("write '(pi/4) rad'"));
}

TEST(ParseData, survives_hostile_expressions) {
  EXPECT_THAT(input_error_of([] { parse_data(std::string(100'000, '('), "", here); }), HasSubstr("longer than 4000"));
  EXPECT_THAT(input_error_of([] { parse_data(std::string(3'999, '('), "", here); }), HasSubstr("malformed"));
}

}  // namespace
}  // namespace sprekk
