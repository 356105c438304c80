#include "framework/converge/error_estimate.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>

namespace sprekk {
namespace {

using testing::DoubleNear;

/// 3 + a h^p + b t^q + c h^p t^q
struct Model {
  double a, p, b, q, c;
  double operator()(double h, double t) const {
    return 3 + a * std::pow(h, p) + b * std::pow(t, q) + c * std::pow(h, p) * std::pow(t, q);
  }
  ValueError error() const {
    const Model& v = *this;
    return value_error({v(2, 1), v(1, 2)}, {v(0.5, 1), v(1, 0.5)}, v(1, 1), v(0.5, 0.5));
  }
};

TEST(ErrorEstimate, is_exact_for_powers_of_one_parameter) {
  for (const double order : {0.6, 1.0, 1.37, 1.99})
    for (const double size : {0.1, -0.1}) {
      const auto value = [&](double h) { return 3 + size * std::pow(h, order); };
      const ValueError found = value_error({value(2)}, {value(0.5)}, value(1), value(0.5));
      EXPECT_THAT(found.extrapolated, DoubleNear(3, 1e-13));
      EXPECT_THAT(found.parameters[0].order, DoubleNear(order, 1e-10));
      for (const double h : {2.0, 0.5, 0.1})  // one and a half times the true error
        EXPECT_THAT(found.stated({h}), DoubleNear(1.5 * std::abs(value(h) - 3), 1e-12));
    }
}

TEST(ErrorEstimate, parts_the_error_among_parameters) {
  const Model model{0.2, 2, -0.3, 1, 0};
  const ValueError found = model.error();
  EXPECT_THAT(found.extrapolated, DoubleNear(3, 1e-12));
  EXPECT_THAT(found.mixed, DoubleNear(0, 1e-12));
  EXPECT_THAT(found.share(0), DoubleNear(0.05 / 0.2, 1e-12));
  EXPECT_THAT(found.share(1), DoubleNear(0.15 / 0.2, 1e-12));
  EXPECT_GE(found.stated({0.5, 0.5}), std::abs(model(0.5, 0.5) - 3));
}

TEST(ErrorEstimate, covers_mixed_terms_and_errors_that_cancel) {
  // Errors of both parameters cancel at the fine level, and the mixed term is left.
  const Model model{0.4, 2, -0.2, 1, 0.1};
  EXPECT_THAT(model(0.5, 0.5) - 3, DoubleNear(0.0125, 1e-12));
  EXPECT_GE(model.error().stated({0.5, 0.5}), 0.0125);
  EXPECT_LE(model.error().stated({0.5, 0.5}), 0.2);
}

TEST(ErrorEstimate, trusts_no_order_where_differences_grow_or_change_their_sign) {
  // After 1 and 1.1: they grow in both directions, and shrink with the other sign, slowly and faster than with an
  // order of two.
  for (const auto& [fine, error] :
       {std::pair{1.5, 0.6}, std::pair{0.9, 0.2}, std::pair{1.06, 0.04}, std::pair{1.09, 0.025}}) {
    const ParameterError found = parameter_error(1, 1.1, fine, 1);
    EXPECT_FALSE(found.is_regular);
    EXPECT_THAT(std::abs(found.error), DoubleNear(error, 1e-14));
    EXPECT_EQ(value_error({1}, {fine}, 1.1, fine).extrapolated, fine);
  }
}

TEST(ErrorEstimate, takes_no_higher_order_than_two) {
  const ParameterError found = parameter_error(3 + 1, 3 + 1.0 / 64, 3 + 1.0 / 4096, 3);  // order 6
  EXPECT_EQ(found.order, 2);
  EXPECT_GE(std::abs(found.error), 1.0 / 4096);
}

TEST(ErrorEstimate, holds_where_the_last_difference_is_small_by_chance) {
  // Errors of second order with scatter: the last two have met. Three times as large would be no news.
  for (const double sign : {1.0, -1.0}) {
    const ValueError found = value_error({3 + sign * 0.16}, {3 + sign * 0.01}, 3 + sign * 0.011, 3 + sign * 0.01);
    EXPECT_GE(found.stated({0.5}), 0.01);
    EXPECT_LE(found.stated({0.5}), 0.03);
    EXPECT_THAT(found.extrapolated, DoubleNear(3 + sign * 0.01, 1e-3));  // nothing is made of the first difference
  }
}

TEST(ErrorEstimate, sees_what_does_not_matter) {
  const ParameterError found = parameter_error(1, 1 + 1e-13, 1 - 1e-13, 1);
  EXPECT_TRUE(found.is_zero);
  EXPECT_EQ(found.error, 0);
}

}  // namespace
}  // namespace sprekk
