#include "framework/picture/display_unit.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

namespace sprekk {
namespace {

TEST(DisplayUnit, is_of_a_sensible_size) {
  EXPECT_EQ(display_unit("Pa", 7.98e6).text, "MPa");
  EXPECT_EQ(display_unit("Pa", 7.98e6).scale, 1e6);
  EXPECT_EQ(display_unit("m", 0.6425e-3).text, "mm");
  EXPECT_EQ(display_unit("m", 2).text, "m");
  EXPECT_EQ(display_unit("m", 4e-6).text, "µm");
  EXPECT_EQ(display_unit("Pa*m^0.5", 0.7e6).text, "MPa·√m");
  EXPECT_EQ(display_unit("rad", 1).text, "°");
  EXPECT_EQ(display_unit("", 30).text, "");
}

TEST(DisplayUnit, of_time_is_hours_for_a_run_of_hours_or_days) {
  EXPECT_EQ(display_unit("s", 60).text, "s");
  EXPECT_EQ(display_unit("s", 600).text, "min");
  EXPECT_EQ(display_unit("s", 30 * 3600).text, "h");
  EXPECT_EQ(display_unit("s", 2 * 86400).text, "h");
  EXPECT_EQ(display_unit("s", 30 * 86400).text, "d");
  EXPECT_EQ(display_unit("s", 1e9).text, "a");
  EXPECT_EQ(display_unit("s", 0.02).text, "ms");
}

TEST(DisplayUnit, has_a_power_of_ten_where_there_is_no_prefix) {
  EXPECT_EQ(display_unit("m^2/s", 5e-9).text, "10⁻⁹ m²/s");
  EXPECT_DOUBLE_EQ(display_unit("m^2/s", 5e-9).scale, 1e-9);
  EXPECT_EQ(display_unit("m^2", 0.02).text, "m²");
}

TEST(DisplayText, has_few_digits_and_a_unit) {
  EXPECT_EQ(display_text(14129385.270509554, "Pa"), "14.13 MPa");
  EXPECT_EQ(display_text(-0.00101470096318054, "m"), "-1.015 mm");
  EXPECT_EQ(display_text(29, ""), "29");
  EXPECT_EQ(display_text(2.5e-16, "m^2"), "2.5·10⁻¹⁶ m²");
  EXPECT_EQ(display_text(1800, display_unit("s", 7200)), "0.5 h");
  EXPECT_EQ(display_text(0, "Pa"), "0 Pa");
  EXPECT_EQ(display_text(std::numeric_limits<double>::quiet_NaN(), "Pa"), "–");
}

TEST(ColumnName, is_quantity_and_unit) {
  EXPECT_EQ(column_name("p_C[Pa]").quantity, "p_C");
  EXPECT_EQ(column_name("p_C[Pa]").unit, "Pa");
  EXPECT_EQ(column_name("iterations[1]").unit, "");
  EXPECT_EQ(column_name("plain").quantity, "plain");
}

}  // namespace
}  // namespace sprekk
