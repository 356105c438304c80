#include "framework/picture/line_plot.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <regex>
#include <set>

#include "framework/picture/thinned.hpp"

namespace sprekk {
namespace {

using testing::HasSubstr;
using testing::Not;

/// The points of the first drawn curve.
std::vector<std::pair<double, double>> points(const std::string& svg) {
  std::smatch path;
  std::vector<std::pair<double, double>> result;
  if (!std::regex_search(svg, path, std::regex("<path d=\"(M[^\"]*)\" fill=\"none\" stroke-width=\"1.6\"")))
    return result;
  const std::string text = path[1];
  const std::regex point("[ML]([-0-9.]+) ([-0-9.]+)");
  for (std::sregex_iterator it(text.begin(), text.end(), point), end; it != end; ++it)
    result.emplace_back(std::stod((*it)[1]), std::stod((*it)[2]));
  return result;
}

TEST(Svg, draws_a_straight_line_straight_and_upwards) {
  Panel panel;
  panel.curves.push_back({"line", {0, 1, 2}, {10, 20, 30}, line_style(0)});
  const auto drawn = points(svg(panel));
  ASSERT_EQ(drawn.size(), 3U);
  EXPECT_NEAR(drawn[1].first, (drawn[0].first + drawn[2].first) / 2, 0.1);
  EXPECT_NEAR(drawn[1].second, (drawn[0].second + drawn[2].second) / 2, 0.1);
  EXPECT_LT(drawn[0].first, drawn[2].first);
  EXPECT_GT(drawn[0].second, drawn[2].second);  // y of a picture points downwards
}

TEST(Svg, interrupts_a_line_where_there_is_no_number) {
  const double nothing = std::numeric_limits<double>::quiet_NaN();
  Panel panel;
  panel.curves.push_back({"gap", {0, 1, 2, 3, 4}, {1, 2, nothing, 4, 5}, line_style(0)});
  const std::string text = svg(panel);
  EXPECT_EQ(points(text).size(), 4U);
  EXPECT_THAT(text, Not(HasSubstr("nan")));
}

TEST(Svg, has_the_same_scale_on_equal_axes) {
  Panel panel;
  panel.equal_axes = true;
  panel.curves.push_back({"diagonal", {0, 1}, {0, 1}, line_style(0)});
  const auto drawn = points(svg(panel));
  EXPECT_NEAR(drawn[1].first - drawn[0].first, drawn[0].second - drawn[1].second, 0.2);
}

TEST(Svg, writes_names_as_text) {
  Panel panel;
  panel.title = "a < b & \"c\"";
  panel.curves.push_back({"p<1>", {0, 1}, {0, 1}, line_style(0)});
  const std::string text = svg_document({panel}, 1);
  EXPECT_THAT(text, HasSubstr("a &lt; b &amp; &quot;c&quot;"));
  EXPECT_THAT(text, HasSubstr("p&lt;1&gt;"));
  EXPECT_THAT(text, Not(HasSubstr("http://www.w3.org/1999")));
}

TEST(LineStyle, differs_for_the_first_thirty_two) {
  std::set<std::string> seen;
  for (int i = 0; i < 32; ++i) seen.insert(line_style(i).colour + line_style(i).dash);
  EXPECT_EQ(seen.size(), 32U);
}

TEST(Viridis, gets_lighter) {
  EXPECT_EQ(viridis(0), "#440154");
  EXPECT_EQ(viridis(1), "#fde725");
  EXPECT_EQ(viridis(7), viridis(1));
}

TEST(Thinned, keeps_the_extremes_of_a_long_curve) {
  Curve curve;
  for (int i = 0; i < 100'000; ++i) {
    curve.x.push_back(i);
    curve.y.push_back(i == 54'321 ? 1e6 : std::sin(1e-3 * i));
  }
  const Curve thin = thinned(curve);
  EXPECT_LE(thin.x.size(), 2400U);
  EXPECT_THAT(thin.y, testing::Contains(1e6));
  EXPECT_EQ(thin.x.front(), 0);
  EXPECT_EQ(thin.x.back(), 99'999);
  EXPECT_TRUE(std::is_sorted(thin.x.begin(), thin.x.end()));
}

}  // namespace
}  // namespace sprekk
