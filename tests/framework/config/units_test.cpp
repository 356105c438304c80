#include "framework/config/units.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "tests/framework/config/messages.hpp"

namespace sprekk {
namespace {

using testing::HasSubstr;

const Origin here{"s.yaml", 3, 4};

struct Quantity {
  const char* text;
  const char* unit;
  double value;
};

class ParseQuantity : public testing::TestWithParam<Quantity> {};

TEST_P(ParseQuantity, gives_the_si_value) {
  const auto& [text, unit, value] = GetParam();
  EXPECT_NEAR(parse_quantity(text, unit, here), value, 4e-16 * std::abs(value)) << text;
}

constexpr double pi = std::numbers::pi;

INSTANTIATE_TEST_SUITE_P(
    all, ParseQuantity,
    testing::Values(Quantity{"2", "", 2}, Quantity{"-2.5e-3", "", -2.5e-3}, Quantity{"0", "Pa", 0},
                    Quantity{"+3", "m", 3}, Quantity{" 3 ", "m", 3}, Quantity{"40 GPa", "Pa", 4e10},
                    Quantity{"40GPa", "Pa", 4e10}, Quantity{"7 kPa", "Pa", 7e3}, Quantity{"7 MPa", "Pa", 7e6},
                    Quantity{"2 bar", "Pa", 2e5}, Quantity{"1 atm", "Pa", 101325}, Quantity{"3 mm", "m", 3e-3},
                    Quantity{"3 cm", "m", 3e-2}, Quantity{"3 km", "m", 3e3}, Quantity{"3 um", "m", 3e-6},
                    Quantity{"3 µm", "m", 3e-6}, Quantity{"3 nm", "m", 3e-9}, Quantity{"5 min", "s", 300},
                    Quantity{"30 h", "s", 108000}, Quantity{"2 d", "s", 172800}, Quantity{"2 day", "s", 172800},
                    Quantity{"1 year", "s", 31557600}, Quantity{"1 ms", "s", 1e-3}, Quantity{"90 deg", "rad", pi / 2},
                    Quantity{"90°", "rad", pi / 2}, Quantity{"1 rad", "rad", 1}, Quantity{"5 J", "N*m", 5},
                    Quantity{"5 kN/m", "Pa*m", 5e3}, Quantity{"5 N", "kg*m/s^2", 5}, Quantity{"2 g", "kg", 2e-3},
                    Quantity{"2 kg", "kg", 2}, Quantity{"2 t", "kg", 2e3}, Quantity{"300 K", "K", 300},
                    Quantity{"1 mPa*s", "Pa*s", 1e-3}, Quantity{"1 cP", "Pa*s", 1e-3},
                    // 1 darcy = 9.869233e-13 m^2, exactly 1e-7/101325 (1 cm^2 cP/(s atm)).
                    Quantity{"1 D", "m^2", 1e-7 / 101325}, Quantity{"1 mD", "m^2", 1e-10 / 101325},
                    Quantity{"2 l", "m^3", 2e-3}, Quantity{"15 %", "", 0.15}, Quantity{"15%", "", 0.15},
                    Quantity{"5e-20 m^2", "m^2", 5e-20}, Quantity{"1 cm^2", "m^2", 1e-4},
                    Quantity{"0.7 MPa*m^0.5", "Pa*m^0.5", 7e5}, Quantity{"0.7 MPa*m^(1/2)", "Pa*m^0.5", 7e5},
                    Quantity{"1 m^2/s", "m^2/s", 1}, Quantity{"4 1/GPa", "1/Pa", 4e-9},
                    Quantity{"4 GPa^-1", "1/Pa", 4e-9}, Quantity{"4 Pa^(-1)", "1/Pa", 4},
                    Quantity{"1 l/min", "m^3/s", 1e-3 / 60}, Quantity{"900 J/(kg*K)", "m^2/(s^2*K)", 900},
                    Quantity{"1 MPa * m ^ 0.5", "kg/(m^0.5*s^2)", 1e6}, Quantity{"1 (kN/m)^2", "Pa^2*m^2", 1e6},
                    Quantity{"9.81 m/s^2", "m/s^2", 9.81}, Quantity{"3 1/h", "1/s", 3. / 3600},
                    Quantity{"1e-320", "m", 1e-320}));

TEST(ParseQuantity, darcy_agrees_with_the_tabulated_value) {
  EXPECT_NEAR(parse_quantity("1 D", "m^2", here), 9.869233e-13, 0.5e-19);
}

struct Wrong {
  const char* text;
  const char* unit;
  const char* message;
};

class WrongQuantity : public testing::TestWithParam<Wrong> {};

TEST_P(WrongQuantity, is_refused) {
  const auto& [text, unit, message] = GetParam();
  EXPECT_THAT(input_error_of([&] { parse_quantity(text, unit, here, "k"); }), HasSubstr(message));
}

INSTANTIATE_TEST_SUITE_P(
    all, WrongQuantity,
    testing::Values(
        Wrong{"40 GPa", "m^2",
              "s.yaml:3:4: '40 GPa' for 'k' has the dimension of pressure (needed is area, in m^2) give it in a unit "
              "like m^2"},
        Wrong{"30 deg", "", "has the dimension of angle (needed is a plain number) write its tangent: 'tan(30 deg)'"},
        Wrong{"0.5 %", "Pa", "has the dimension of plain number"},
        Wrong{"1 MPa*m", "Pa*m^0.5", "has the dimension of force per length (needed is stress intensity, in Pa*m^0.5)"},
        Wrong{"1 m^3*K", "m", "has the dimension of m^3*K"}, Wrong{"1 m^0.5", "m^0.4999", "has the dimension of"},
        Wrong{"2 Mpa", "Pa", "unknown unit 'Mpa' in '2 Mpa' for 'k'"}, Wrong{"2 Mpa", "Pa", "did you mean 'MPa'?"},
        Wrong{"2 hours", "s", "unknown unit 'hours'"}, Wrong{"2 kmin", "s", "unknown unit 'kmin'"},
        Wrong{"80 degC", "K", "unknown unit 'degC' in '80 degC' for 'k' (temperatures are in K"},
        Wrong{"80 C", "K", "write 353.15 K for 80 degrees Celsius"},
        Wrong{"1 Pa s", "Pa*s", "an operator is missing before 's') products are written with '*': Pa*s"},
        Wrong{"1 m2", "m^2", "has a unit without '^' (powers are written with '^') write '1 m^2'"},
        Wrong{"2300 kg/m3", "kg/m^3", "write '2300 kg/m^3'"}, Wrong{"2 g/cm3", "kg/m^3", "write '2 g/cm^3'"},
        Wrong{"2.3 g/cc", "kg/m^3", "has the unit 'cc' (powers are written with '^') write '2.3 g/cm^3'"},
        Wrong{"1e-17 m**2", "m^2", "has '**' (powers are written with '^') write '1e-17 m^2'"},
        Wrong{"1 e-17 m^2", "m^2", "has a blank in its number write '1e-17 m^2'"},
        Wrong{"10^-17 m^2", "m^2", "(powers of ten are written with 'e') write '1e-17 m^2'"},
        Wrong{"2.5*10^(-17) m^2", "m^2", "write '2.5e-17 m^2'"}, Wrong{"“5 MPa”", "Pa", "has a quotation mark “"},
        Wrong{"30 deg", "", "has the dimension of angle (needed is a plain number) write its tangent: 'tan(30 deg)'"},
        Wrong{"1 m^1/2", "m^0.5", "the number 2 stands in the unit"}, Wrong{"1 m^", "m", "a power must be a number"},
        Wrong{"1 m^99", "m", "a power must be a number from -12 to 12"},
        Wrong{"1 m^nan", "m", "a power must be a number"}, Wrong{"1 m^(1/0)", "m", "has the dimension of"},
        Wrong{"1 (m", "m", "a ')' is missing"}, Wrong{"1 m)", "m", "there is one ')' too many"},
        Wrong{"1 m*", "m", "a unit is missing at its character 3"},
        Wrong{"1 /s", "1/s", "a unit is missing at its character 1"}, Wrong{"nan", "m", "'nan' for 'k' is not finite"},
        Wrong{".inf", "m", "is not finite"}, Wrong{"-inf", "m", "is not finite"}, Wrong{"-.inf", "m", "is not finite"},
        Wrong{"infinity", "m", "is not finite"}, Wrong{"1e999", "m", "is not finite"},
        Wrong{"1e305 GPa", "Pa", "is not finite"}, Wrong{"", "m", "is not a number with a unit"},
        Wrong{"MPa", "Pa", "is not a number with a unit"}, Wrong{"nano", "Pa", "is not a number with a unit"},
        Wrong{"20", "Pa",
              "has no unit (needed is pressure, in Pa or another unit of it) write '20 MPa', '20 GPa' or '20 Pa', if "
              "that is"},
        Wrong{"45", "rad", "has no unit (needed is angle, in rad or another unit of it) write '45 deg'"},
        Wrong{"+-3", "Pa", "is not a number"}, Wrong{"abc", "", "is not a number (needed is a plain number)"},
        Wrong{"0x10", "", "unknown unit 'x10'"}, Wrong{"1,5 m", "m", "has a decimal comma"}));

TEST(ParseQuantity, survives_hostile_units) {
  EXPECT_THAT(input_error_of([] { parse_quantity("1 " + std::string(100'000, '('), "m", here); }),
              HasSubstr("too long"));
}

TEST(QuantityText, reads_back) {
  for (const double value : {1.0 / 3, 5e-20, 1e300, -0.1}) {
    EXPECT_EQ(parse_quantity(quantity_text(value, "kg/m^3"), "kg/m^3", here), value);
  }
  EXPECT_EQ(quantity_text(1000, "kg/m^3"), "1000 kg/m^3");
}

}  // namespace
}  // namespace sprekk
