// Data in all forms that a scene may write: by region, windows in time, vectors and tensors.
#include "framework/config/data_reader.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "framework/config/yaml/parse_yaml.hpp"
#include "tests/framework/config/messages.hpp"

namespace sprekk {
namespace {

using testing::AllOf;
using testing::ElementsAre;
using testing::HasSubstr;
using testing::IsEmpty;

ReadContext regions() {
  ReadContext context;
  context.region_names = {"granite", "lens"};
  context.fracture_names = {"fault", "joint", "vein"};
  context.fracture_values = {{{"friction", "", 0.3, {"f.csv", 2}}, {"width", "mm", 2, {"f.csv", 2}}},
                             {{"friction", "", 0.6, {"f.csv", 3}}, {"width", "mm", -1, {"f.csv", 3}}},
                             {}};
  return context;
}

Data data(const std::string& text, About about = {}) {
  const ReadContext context = regions();
  about.in_time = true;
  return read_data(*parse_yaml("v: " + text, "s.yaml").find("v"), {"k", about, context});
}

VectorData vector(const std::string& text, About about = {}) {
  const ReadContext context = regions();
  about.in_time = true;
  return read_vector(*parse_yaml("v: " + text, "s.yaml").find("v"), {"k", about, context});
}

TensorData tensor(const std::string& text, About about = {}) {
  const ReadContext context = regions();
  about.in_time = true;
  return read_tensor(*parse_yaml("v: " + text, "s.yaml").find("v"), {"k", about, context});
}

Place in_region(int region) { return {Point::Zero(), region, 0}; }
Place on_fracture(int fracture, double t = 0) { return {Point::Zero(), 0, t, fracture}; }
Place at_time(double t) { return {Point::Zero(), 0, t}; }

TEST(ReadData, by_region) {
  const Data k = data("{regions: {granite: 1e-18 m^2, lens: 1 D}}", {.unit = "m^2"});
  EXPECT_EQ(k.at(in_region(0)), 1e-18);
  EXPECT_EQ(k.at(in_region(1)), 1e-7 / 101325);
  EXPECT_FALSE(k.is_constant());
  EXPECT_TRUE(k.depends_on_space());
  EXPECT_FALSE(k.depends_on_time());
}

TEST(ReadData, by_fracture) {
  const Data k = data("{fractures: {fault: 2 mm, joint: (t) m, default: 1 cm}}", {.unit = "m"});
  EXPECT_DOUBLE_EQ(k.at(on_fracture(0)), 2e-3);
  EXPECT_EQ(k.at(on_fracture(1, 7)), 7);
  EXPECT_DOUBLE_EQ(k.at(on_fracture(2)), 1e-2);
  EXPECT_TRUE(k.depends_on_space());
  EXPECT_TRUE(k.depends_on_time());
}

TEST(ReadData, by_a_column_of_the_tables_of_fractures) {
  const Data k = data("{column: friction, default: 0.5}");
  EXPECT_EQ(k.at(on_fracture(0)), 0.3);
  EXPECT_EQ(k.at(on_fracture(1)), 0.6);
  EXPECT_EQ(k.at(on_fracture(2)), 0.5);
  EXPECT_DOUBLE_EQ(data("{column: width, default: 1 m}", {.unit = "m"}).at(on_fracture(0)), 2e-3);
}

TEST(ReadData, by_fracture_has_no_value_in_the_rock) {
  const Data k = data("{fractures: {default: 1}}");
  try {
    k.at(in_region(0));
    FAIL();
  } catch (const DataError& error) {
    EXPECT_THAT(error.what(),
                AllOf(HasSubstr("s.yaml:1:4"), HasSubstr("'k' is given by fracture"), HasSubstr("elsewhere")));
  }
}

TEST(ReadData, by_region_with_a_default_and_a_function) {
  const Data k = data("{regions: {lens: t, default: 3}}");
  EXPECT_EQ(k.at({Point::Zero(), 0, 5}), 3);
  EXPECT_EQ(k.at({Point::Zero(), 1, 5}), 5);
  EXPECT_TRUE(k.depends_on_time());
}

TEST(ReadData, in_a_window_that_includes_its_beginning_and_not_its_end) {
  const Data q = data("{value: 5e-9 m^2/s, from: 6 h, to: 21 h}", {.unit = "m^2/s", .range = non_negative()});
  const double from = 6 * 3600, to = 21 * 3600;
  EXPECT_EQ(q.at(at_time(0)), 0);
  EXPECT_EQ(q.at(at_time(std::nextafter(from, 0))), 0);
  EXPECT_EQ(q.at(at_time(from)), 5e-9);
  EXPECT_EQ(q.at(at_time(std::nextafter(to, 0))), 5e-9);
  EXPECT_EQ(q.at(at_time(to)), 0);
  EXPECT_THAT(q.switch_times(), ElementsAre(from, to));
  EXPECT_TRUE(q.depends_on_time());
  EXPECT_FALSE(q.depends_on_space());
}

TEST(ReadData, in_windows_that_add_up) {
  const Data q = data("[{value: 1, to: 20 s}, {value: 10, from: 10 s, to: 30 s}, {value: 100*x, from: 20 s}]");
  const auto at = [&](double t) { return q.at({{2, 0}, 0, t}); };
  EXPECT_EQ(at(-5), 1);
  EXPECT_EQ(at(9), 1);
  EXPECT_EQ(at(10), 11);
  EXPECT_EQ(at(20), 210);
  EXPECT_EQ(at(30), 200);
  EXPECT_THAT(q.switch_times(), ElementsAre(10, 20, 30));
  EXPECT_TRUE(q.depends_on_space());
}

TEST(ReadData, a_window_without_ends_is_its_value) {
  const Data q = data("{value: 3}");
  EXPECT_TRUE(q.is_constant());
  EXPECT_EQ(q.at({}), 3);
  EXPECT_THAT(q.switch_times(), IsEmpty());
}

TEST(ReadData, a_window_may_hold_values_by_region) {
  const Data q = data("{value: {regions: {granite: 1, default: 2}}, from: 10 s}");
  EXPECT_EQ(q.at({Point::Zero(), 1, 10}), 2);
  EXPECT_EQ(q.at({Point::Zero(), 1, 9}), 0);
}

TEST(ReadData, regions_keep_the_switch_times_of_their_windows) {
  const Data q = data("{regions: {granite: {value: 1, from: 5 s}, lens: {value: 1, from: 2 s}}}");
  EXPECT_THAT(q.switch_times(), ElementsAre(2, 5));
}

TEST(ReadData, checks_the_range_of_functions_when_they_are_evaluated) {
  const Data k = data("x m^2", {.unit = "m^2", .range = positive()});
  EXPECT_EQ(k.at({{2, 0}, 0, 0}), 2);
  EXPECT_EQ(runtime_error_of([&] {
              k.at({{-1, 0}, 0, 7});
            }),
            "s.yaml:1:4: 'k' is -1 at x = -1, y = 0, t = 7 (it must be > 0 m^2)");
}

struct Wrong {
  const char* text;
  const char* message;
};

class WrongData : public testing::TestWithParam<Wrong> {};

TEST_P(WrongData, is_refused) {
  const About about{.unit = "m", .range = positive()};
  EXPECT_THAT(input_error_of([&] { data(GetParam().text, about); }), HasSubstr(GetParam().message));
}

INSTANTIATE_TEST_SUITE_P(
    all, WrongData,
    testing::Values(
        Wrong{"-1", "s.yaml:1:4: 'k' is '-1 m', out of range (it must be > 0 m)"},
        Wrong{"", "s.yaml:1:1: 'k' has no value (needed is a number in m, an expression"},
        Wrong{"{}", "s.yaml:1:4: 'k' is a map (needed is a number in m"},
        Wrong{"{regions: {granite: 1}}",
              "s.yaml:1:14: 'k' has no value in the region 'lens' add 'lens:' or 'default:'"},
        Wrong{"{regions: {granit: 1, default: 2}}",
              "s.yaml:1:15: unknown region 'granit' (it is not one of: granite, lens) did you mean 'granite'?"},
        Wrong{"{regions: {granite: -1, default: 2}}", "s.yaml:1:24: 'k' is '-1 m', out of range"},
        Wrong{"{regions: {granite: 1 s, default: 2}}", "s.yaml:1:24: '1 s' for 'k' has the dimension of time"},
        Wrong{"{fractures: {fault: 1 m}}", "'k' has no value on the fracture 'joint' add 'joint:' or 'default:'"},
        Wrong{"{fractures: {foult: 1 m, default: 1 m}}", "unknown fracture 'foult'"},
        Wrong{"{fractures: {fault: -1 m, default: 1 m}}", "'k' is '-1 m', out of range"},
        Wrong{"{fractures: 2 m}", "needed is a map of a value for each fracture"},
        Wrong{"{column: friktion, default: 1 m}", "did you mean 'friction'?"},
        Wrong{"{column: width}", "f.csv:3: 'k' is '-0.001 m', out of range"},
        Wrong{"{column: friction}", "'k' has no value on the fracture 'vein'"},
        Wrong{"{column: width, unit: mm}", "unknown key of 'k': 'unit'"},
        Wrong{"{regions: 3}", "'k.regions' is '3' (needed is a map of a value for each region)"},
        Wrong{"{regions: {default: 1}, table: a}", "unknown key of 'k': 'table'"},
        Wrong{"{region: {default: 1}}", "did you mean 'regions'?"}, Wrong{"{value: 1, from: 6 h}", "'k' is 0 at t ="},
        Wrong{"{value: 1, form: 6 h}",
              "unknown key of 'k': 'form' (it is not one of: value, from, to) did you mean 'from'?"},
        Wrong{"{value: 1, from: 6 m}", "'6 m' for 'k.from' has the dimension of length"},
        Wrong{"{value: 1, from: 5 s, to: 5 s}", "the window of 'k' is empty (it begins at 5 s and ends at 5 s)"},
        Wrong{"[]", "'k' is an empty list of windows"},
        Wrong{"[1, 2]", "'k' is a list with '1' (a list gives windows in time"},
        Wrong{"[{from: 1 s}]", "'value' is missing for 'k'"}));

TEST(ReadData, checks_the_sum_of_constant_windows) {
  const About about{.range = between(0, 5)};
  EXPECT_THAT(input_error_of([&] { data("[{value: 3, from: 1 s, to: 4 s}, {value: 3, from: 2 s}]", about); }),
              HasSubstr("'k' is 6 at t = 2 s, out of range (it must be from 0 to 5"));
  EXPECT_NO_THROW(data("[{value: -3, from: 1 s, to: 4 s}, {value: 3, from: 0 s, to: 5 s}]", about));
}

TEST(ReadData, may_have_to_be_constant) {
  const About about{.constant_only = true};
  EXPECT_EQ(data("2*pi", about).at({}), 2 * std::numbers::pi);
  EXPECT_THAT(input_error_of([&] { data("2*x", about); }), HasSubstr("one number that does not depend on x, y or t"));
  EXPECT_THAT(input_error_of([&] { data("{regions: {default: 1}}", about); }), HasSubstr("needed is one number"));
}

TEST(ReadData, may_only_change_with_time_where_it_is_evaluated_in_every_step) {
  const auto message = [](const std::string& text) {
    const ReadContext context = regions();
    return input_error_of([&] {
      read_data(*parse_yaml("v: " + text, "s.yaml").find("v"), {"k", {.fixed = "it is fixed"}, context});
    });
  };
  for (const char* text : {"1 + t", "{value: 2, from: 3 s}", "{regions: {lens: t, default: 1}}", "if(t > 5, 1, 2)"})
    EXPECT_THAT(message(text), AllOf(HasSubstr("depends on time"), HasSubstr("(it is fixed)")));
}

TEST(ReadVector, has_two_components) {
  const VectorData g = vector("[0, -9.81 m/s^2]", {.unit = "m/s^2"});
  EXPECT_EQ(g.at({}), Point(0, -9.81));
  const VectorData u = vector("[{value: 1, from: 5 s}, {value: 2, from: 3 s}]");
  EXPECT_THAT(u.switch_times(), ElementsAre(3, 5));
  EXPECT_TRUE(u.depends_on_time());
}

TEST(ReadVector, has_neither_less_nor_more) {
  EXPECT_THAT(input_error_of([] { vector("[1]"); }),
              HasSubstr("'k' has 1 values (needed is a list of two values [x, y])"));
  EXPECT_THAT(input_error_of([] { vector("[1, 2, 3]"); }), HasSubstr("'k' has 3 values"));
  EXPECT_THAT(input_error_of([] { vector("5"); }), HasSubstr("'k' is '5' (needed is a list of two values [x, y])"));
}

const About permeability{.unit = "m", .range = positive()};  // lengths need no unit

TEST(ReadTensor, isotropic) {
  const TensorData k = tensor("2 m", permeability);
  EXPECT_EQ(k.at({}), Tensor(2 * Tensor::Identity()));
  EXPECT_TRUE(k.component[2].is_zero());
  EXPECT_EQ(tensor("{value: 2, from: 3 s}").at(at_time(3)), Tensor(2 * Tensor::Identity()));
}

TEST(ReadTensor, by_components) {
  Tensor expected;
  expected << 3, 1, 1, 2;
  EXPECT_EQ(tensor("{xx: 3, yy: 2, xy: 1}", permeability).at({}), expected);
  EXPECT_EQ(tensor("{xx: 3, yy: 2}", permeability).at({})(0, 1), 0);
}

TEST(ReadTensor, by_principal_values_is_the_rotated_diagonal) {
  const double angle = 30 * std::numbers::pi / 180;
  Tensor rotation;
  rotation << std::cos(angle), -std::sin(angle), std::sin(angle), std::cos(angle);
  const Tensor expected = rotation * Eigen::Vector2d(5, 2).asDiagonal() * rotation.transpose();
  const TensorData k = tensor("{along: 5, across: 2, angle: 30 deg}", permeability);
  EXPECT_TRUE(k.component[0].is_constant());
  EXPECT_LT((k.at({}) - expected).norm(), 1e-15 * 5);
  const TensorData varying = tensor("{along: 5*x, across: 2, angle: 30 deg}", permeability);
  EXPECT_LT((varying.at({{1, 0}, 0, 0}) - expected).norm(), 1e-15 * 5);
}

TEST(ReadTensor, by_region) {
  const TensorData k = tensor("{regions: {granite: 1, lens: {along: 4, across: 1, angle: 90 deg}}}", permeability);
  EXPECT_EQ(k.at(in_region(0)), Tensor(Tensor::Identity()));
  EXPECT_LT((k.at(in_region(1)) - Tensor(Eigen::Vector2d(1, 4).asDiagonal())).norm(), 1e-15);
  EXPECT_TRUE(tensor("{regions: {granite: 1, lens: 2}}").component[2].is_zero());
}

TEST(ReadTensor, is_positive_definite_where_it_must_be) {
  const auto message = [](const char* text) { return input_error_of([&] { tensor(text, permeability); }); };
  EXPECT_EQ(message("{xx: 1, yy: 1, xy: 2}"),
            "s.yaml:1:4: 'k' is not positive definite (xx yy = 1 must be larger than xy^2 = 4)");
  EXPECT_THAT(message("{xx: 1, yy: -1, xy: 0}"), HasSubstr("'k' is '-1 m', out of range"));
  EXPECT_THAT(message("{along: 0, across: 1, angle: 0}"), HasSubstr("out of range"));
  const TensorData k = tensor("{xx: 1, yy: 1, xy: x}", permeability);
  EXPECT_EQ(k.at({{0.5, 0}, 0, 0})(0, 1), 0.5);
  EXPECT_THAT(runtime_error_of([&] { k.at({{1, 0}, 0, 0}); }), HasSubstr("'k' is not positive definite at x = 1"));
  EXPECT_EQ(tensor("{xx: -1 Pa, yy: -1 Pa, xy: 2 Pa}", {.unit = "Pa"}).at({})(0, 1), 2);  // a stress may have any sign
}

TEST(ReadTensor, wrong_maps_are_refused) {
  const auto message = [](const char* text) { return input_error_of([&] { tensor(text, permeability); }); };
  EXPECT_THAT(message("{xx: 1}"), HasSubstr("'yy' is missing for 'k'"));
  EXPECT_THAT(message("{xx: 1, yy: 1, yx: 0}"), HasSubstr("unknown key of 'k': 'yx'"));
  EXPECT_THAT(message("{along: 1, across: 1}"), HasSubstr("'angle' is missing for 'k'"));
  EXPECT_THAT(message("{along: 1, across: 1, angle: 1 m}"),
              HasSubstr("'1 m' for 'k.angle' has the dimension of length"));
  EXPECT_THAT(message("{zz: 1}"), HasSubstr("unknown key of 'k': 'zz' (it is not one of: xx, along, regions"));
}

TEST(WithinRange, TakesTheBoundForAValueThatRoundOffMovesBeyondIt) {
  const Data share = data("if(t < 5, 1, max(0, 1 - (t - 5)/3))", {.range = between(0, 1)});
  EXPECT_NEAR(share.at(at_time(6.5)), 0.5, 1e-15);
  // 1 - t/4 is 1.0000000000000004 just before the start, as a sum of steps may miss it.
  EXPECT_EQ(data("1 - t/4", {.range = between(0, 1)}).at(at_time(-1.8e-15)), 1);
  EXPECT_EQ(data("1 - t/4", {.range = between(0, 1)}).at(at_time(4 + 4e-15)), 0);
  // The scale of a pressure that falls to zero is the pressure before.
  const Data pressure = data("5 MPa*(1 - t/(10 s))", {.unit = "Pa", .range = non_negative()});
  EXPECT_EQ(pressure.at(at_time(10 + 2e-15)), 0);
  EXPECT_THROW(pressure.at(at_time(10.0001)), DataError);
  EXPECT_THROW(data("1 - t/4", {.range = between(0, 1)}).at(at_time(-1e-9)), DataError);
  EXPECT_THROW(data("x*1e-20", {.range = positive()}).at({Point(0, 0), 0, 0}), DataError);  // an open bound
  EXPECT_THROW(data("0.3 - 0.30001", {.range = non_negative()}), InputError);
}

}  // namespace
}  // namespace sprekk
