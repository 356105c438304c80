#include "framework/picture/history_panel.hpp"

#include <gtest/gtest.h>

namespace sprekk {
namespace {

TEST(HistoryPanel, lets_a_covered_curve_be_seen) {
  const std::vector<double> times = {0, 1, 2, 3};
  const Panel panel = history_panel("K", "Pa*m^0.5",
                                    {{"below", times, {0, 1, 2, 3}, line_style(0)},
                                     {"other", times, {3, 2, 1, 0}, line_style(1)},
                                     {"above", times, {0, 1, 2, 3.001}, line_style(2)},
                                     {"third", times, {0, 1, 2, 3}, line_style(3)}});
  EXPECT_EQ(panel.curves[0].style.dash, "");
  EXPECT_EQ(panel.curves[1].style.dash, "");
  EXPECT_NE(panel.curves[2].style.dash, "");
  EXPECT_NE(panel.curves[3].style.dash, "");
  EXPECT_NE(panel.curves[3].style.dash, panel.curves[2].style.dash);
}

TEST(HistoryPanel, does_not_dash_what_is_apart_or_has_other_times) {
  const Panel panel = history_panel("p", "Pa",
                                    {{"one", {0, 1, 2}, {1, 1, 1}, line_style(0)},
                                     {"apart", {0, 1, 2}, {1, 2, 3}, line_style(1)},
                                     {"other times", {0, 1, 3}, {1, 1, 1}, line_style(2)}});
  for (const Curve& curve : panel.curves) EXPECT_EQ(curve.style.dash, "");
}

}  // namespace
}  // namespace sprekk
