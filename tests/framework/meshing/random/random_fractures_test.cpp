#include "framework/meshing/random/random_fractures.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <numbers>
#include <string>

#include "framework/mesh/plane/planar.hpp"

namespace sprekk {
namespace {

using std::numbers::pi;

Geometry box(double width, double height = 0) {
  Geometry geometry;
  geometry.box = {{0, 0}, {width, height > 0 ? height : width}, {}};
  return geometry;
}

RandomFractures set_of(int number, double length) {
  RandomFractures set;
  set.name = "joints";
  set.origin = {"scene.yaml", 7};
  set.number = number;
  set.length = {.value = length, .shortest = length, .longest = length};
  return set;
}

Segment segment(const FractureGeometry& fracture) { return {fracture.points.front(), fracture.points.back()}; }
Point along(const FractureGeometry& fracture) { return fracture.points.back() - fracture.points.front(); }
Point middle(const FractureGeometry& fracture) { return 0.5 * (fracture.points.back() + fracture.points.front()); }

std::vector<Segment> drawn(const RandomFractures& set, Geometry geometry) {
  draw_fractures(set, geometry);
  std::vector<Segment> all;
  for (const FractureGeometry& fracture : geometry.fractures) all.push_back(segment(fracture));
  return all;
}

/// The largest distance between the shares of a sample and those of a law, times the root of its size; above 1.95 for
/// one sample of 1000 that follows the law.
double kolmogorov(std::vector<double> sample, const std::function<double(double)>& share) {
  std::sort(sample.begin(), sample.end());
  const auto n = static_cast<double>(sample.size());
  double largest = 0;
  for (std::size_t i = 0; i < sample.size(); ++i)
    largest = std::max(
        {largest, static_cast<double>(i + 1) / n - share(sample[i]), share(sample[i]) - static_cast<double>(i) / n});
  return largest * std::sqrt(n);
}

TEST(RandomFractureSets, FollowTheLawsAlsoWhereFewPlacesAreFree) {
  Geometry geometry = box(300);
  RandomFractures set = set_of(400, 0);
  set.length = {.kind = LengthLaw::Kind::power, .exponent = 2.5, .shortest = 5, .longest = 60};
  set.mean_angle = 0.7;
  set.least_gap = 0.5;
  set.least_angle = 0.35;
  draw_fractures(set, geometry);
  std::vector<double> lengths, angles;
  for (const FractureGeometry& fracture : geometry.fractures) {
    lengths.push_back(along(fracture).norm());
    angles.push_back(std::atan2(along(fracture).y(), along(fracture).x()));
  }
  EXPECT_EQ(lengths.size(), 400u);
  const auto primitive = [](double x) { return -std::pow(x, -1.5); };
  const auto power = [&](double x) { return (primitive(x) - primitive(5)) / (primitive(60) - primitive(5)); };
  EXPECT_LT(kolmogorov(lengths, power), 1.95);
  EXPECT_LT(kolmogorov(angles, [](double a) { return (a + pi) / (2 * pi); }), 1.95);
  EXPECT_TRUE(std::ranges::is_sorted(lengths, [](double a, double b) { return a > b + 1e-3; }));
  EXPECT_EQ(geometry.fractures.front().name, "joints_1");
}

TEST(RandomFractureSets, KeepTheirDistances) {
  Geometry geometry = box(100, 80);
  geometry.fractures.push_back({"given", {{20, 20}, {50, 40}, {90, 30}}, std::nullopt, {}});
  geometry.regions.push_back({"layer", {{0, 60}, {100, 65}, {100, 80}, {0, 80}}, {}});
  RandomFractures set = set_of(60, 12);
  set.least_gap = 1;
  set.least_angle = 0.5;
  draw_fractures(set, geometry);
  std::vector<Segment> lines;
  for (const FractureGeometry& fracture : geometry.fractures)
    for (std::size_t i = 0; i + 1 < fracture.points.size(); ++i)
      lines.push_back({fracture.points[i], fracture.points[i + 1]});
  lines.push_back({{0, 60}, {100, 65}});
  ASSERT_EQ(lines.size(), 63u);
  std::vector<Point> crossings;
  for (std::size_t i = 2; i < lines.size(); ++i) {
    for (const Point& end : {lines[i].from, lines[i].to}) {
      if (i == 62) break;
      EXPECT_GE(std::min({end.x(), 100 - end.x(), end.y(), 80 - end.y()}), 1);
    }
    for (std::size_t j = 0; j < i; ++j) {
      const Segment &a = lines[i], &b = lines[j];
      EXPECT_GE(std::min({distance(a.from, b), distance(a.to, b), distance(b.from, a), distance(b.to, a)}), 1);
      Point crossing;
      if (!cross_inside(a, b, crossing)) continue;
      const Point u = (a.to - a.from).normalized(), v = (b.to - b.from).normalized();
      EXPECT_LE(std::abs(u.dot(v)), std::cos(0.5) + 1e-12);
      for (const Point& other : crossings) EXPECT_GE((other - crossing).norm(), 1 - 1e-12);
      crossings.push_back(crossing);
    }
  }
  EXPECT_GT(crossings.size(), 10u);
}

TEST(RandomFractureSets, HaveTheDensityThatIsAskedFor) {
  RandomFractures set = set_of(1, 2);
  set.number = std::nullopt;
  set.region = Box{{20, 30}, {70, 90}, {}};  // 3000 m^2
  set.density = 0.05;
  EXPECT_EQ(drawn(set, box(100)).size(), 150u);
  set.density = std::nullopt;
  set.intensity = 0.2;  // 600 m
  set.length = {.kind = LengthLaw::Kind::lognormal, .median = 3, .deviation = 0.5, .shortest = 1, .longest = 9};
  double sum = 0;
  for (const Segment& fracture : drawn(set, box(100))) sum += fracture.length();
  EXPECT_NEAR(sum, 600, 4.5);  // half of the longest
}

TEST(RandomFractureSets, PlacesAreUniformInTheRegion) {
  RandomFractures set = set_of(3000, 0.01);
  set.region = Box{{2, 5}, {4, 9}, {}};
  Geometry geometry = box(10);
  draw_fractures(set, geometry);
  std::vector<double> x, y;
  for (const FractureGeometry& fracture : geometry.fractures) {
    x.push_back(middle(fracture).x());
    y.push_back(middle(fracture).y());
  }
  EXPECT_LT(kolmogorov(x, [](double v) { return (v - 2) / 2; }), 1.95);
  EXPECT_LT(kolmogorov(y, [](double v) { return (v - 5) / 4; }), 1.95);
}

TEST(RandomFractureSets, TurnWithTheirMeanDirection) {
  RandomFractures set = set_of(40, 3);
  set.concentration = 15;
  set.mean_angle = 0.2;
  set.region = Box{{40, 40}, {60, 60}, {}};  // nothing is refused for its place
  Geometry straight = box(100), turned = box(100);
  draw_fractures(set, straight);
  set.mean_angle += 0.5;
  draw_fractures(set, turned);
  const double grid = 1e-4;
  for (std::size_t i = 0; i < 40; ++i) {
    const Point a = along(straight.fractures[i]), b = along(turned.fractures[i]);
    EXPECT_NEAR(std::atan2(cross(a, b), a.dot(b)), 0.5, 2 * grid / 3);
    EXPECT_LT((middle(straight.fractures[i]) - middle(turned.fractures[i])).norm(), 2 * grid);
  }
}

TEST(RandomFractureSets, DependOnSeedAndNameOnly) {
  const auto places = [](int seed, const std::string& name) {
    RandomFractures set = set_of(20, 5);
    set.seed = seed;
    set.name = name;
    std::vector<double> all;
    for (const Segment& fracture : drawn(set, box(100)))
      all.insert(all.end(), {fracture.from.x(), fracture.from.y(), fracture.to.x(), fracture.to.y()});
    return all;
  };
  EXPECT_EQ(places(1, "a"), places(1, "a"));
  EXPECT_NE(places(1, "a"), places(2, "a"));
  EXPECT_NE(places(1, "a"), places(1, "b"));
}

TEST(RandomFractureSets, HaveCoordinatesOfFewDigits) {
  for (const double size : {3e-3, 1.0, 100.0, 2e7}) {
    for (const Segment& fracture : drawn(set_of(5, size / 20), box(size))) {
      char text[40];
      std::snprintf(text, sizeof text, "%.8g", fracture.from.x());
      EXPECT_EQ(std::stod(text), fracture.from.x()) << size;
    }
  }
}

TEST(RandomFractureSets, SayWhyTheyCannotBeDrawn) {
  using ::testing::AllOf;
  using ::testing::HasSubstr;
  const auto mistake = [](const RandomFractures& set) -> std::string {
    Geometry geometry = box(10);
    try {
      draw_fractures(set, geometry);
    } catch (const InputError& error) {
      return error.what();
    }
    return "";
  };
  RandomFractures set = set_of(500, 2);
  set.least_gap = 0.5;
  EXPECT_THAT(mistake(set), AllOf(HasSubstr("scene.yaml:7"), HasSubstr("no place for fracture"),
                                  HasSubstr("of 500 of the random set 'joints'"), HasSubstr("fewer or shorter")));
  EXPECT_THAT(mistake(set_of(1, 15)), HasSubstr("no place for fracture 1 of 1"));
  set = set_of(3, 1);
  set.region = Box{{5, 5}, {11, 6}, {"scene.yaml", 9}};
  EXPECT_THAT(mistake(set), AllOf(HasSubstr("scene.yaml:9"), HasSubstr("leaves the box")));
  set = set_of(3, 1);
  set.number = std::nullopt;
  set.density = 1e-3;
  EXPECT_THAT(mistake(set), HasSubstr("has no fracture"));
  set.density = 1e4;
  EXPECT_THAT(mistake(set), HasSubstr("more than 10000 fractures"));
}

}  // namespace
}  // namespace sprekk
