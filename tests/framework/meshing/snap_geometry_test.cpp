#include "framework/meshing/joining/snap_geometry.hpp"

#include <map>
#include <set>

#include "framework/mesh/quality/mesh_quality.hpp"
#include "framework/meshing/fracture_table.hpp"
#include "framework/meshing/generate_mesh.hpp"
#include "framework/meshing/plane/arrangement.hpp"
#include "framework/meshing/validate_geometry.hpp"
#include "tests/framework/meshing/digitized_network.hpp"

namespace sprekk::test {
namespace {

using testing::AllOf;
using testing::HasSubstr;
using testing::IsEmpty;

const MeshOptions coarse = {.size = 4, .fracture_size = 2};

/// How many points of the network have one, two, … arms, and its length (m).
struct Network {
  std::map<std::size_t, int> points_with_arms;
  double length = 0;
};

/// Of the arrangement, in which no two pieces may be the same.
Network network(const Geometry& geometry) {
  const std::vector<Segment> segments = all_segments(geometry);
  const Arrangement arrangement = arrange(segments, point_tolerance(geometry.box));
  std::map<int, std::set<int>> arms;
  std::set<std::pair<int, int>> pieces;
  Network network;
  for (std::size_t s = 4; s < segments.size(); ++s)
    for (std::size_t i = 0; i + 1 < arrangement.chains[s].size(); ++i) {
      const int a = arrangement.chains[s][i], b = arrangement.chains[s][i + 1];
      EXPECT_TRUE(pieces.insert(std::minmax(a, b)).second);
      arms[a].insert(b);
      arms[b].insert(a);
      network.length += (arrangement.points[a] - arrangement.points[b]).norm();
    }
  for (const auto& [point, others] : arms) ++network.points_with_arms[others.size()];
  return network;
}

Geometry snapped(Geometry geometry, const MeshOptions& options = coarse) {
  snap_geometry(geometry, options);
  return geometry;
}

TEST(SnapGeometry, NetworksHaveOneTopology) {
  for (const unsigned seed : {1u, 2u, 3u}) {
    const Geometry drawn = digitized_network(150, seed);
    const Geometry joined = snapped(drawn);
    EXPECT_NO_THROW(validate_geometry(joined, coarse));
    const Network expected = network(joined);
    EXPECT_LT(joined.fractures.size(), drawn.fractures.size());
    const auto expect_same = [&](Geometry twin, double rounding) {
      snap_geometry(twin, coarse);
      const Network found = network(twin);
      EXPECT_EQ(found.points_with_arms, expected.points_with_arms);
      EXPECT_NEAR(found.length, expected.length, rounding * expected.length);
    };
    for (const auto& [angle, mirror] : {std::pair(0.3, 1), {1.234, 1}, {0.0, -1}, {2.0, -1}}) {
      Geometry twin = drawn;
      twin.box = {{-50, -50}, {150, 150}, {}};
      for (FractureGeometry& trace : twin.fractures)
        for (Point& x : trace.points) {
          const Point from(mirror * (x.x() - 50), x.y() - 50);
          x = Point(50, 50) + Point(std::cos(angle) * from.x() - std::sin(angle) * from.y(),
                                    std::sin(angle) * from.x() + std::cos(angle) * from.y());
        }
      expect_same(twin, 1e-12);
    }
    Geometry shuffled = drawn;
    std::mt19937 random(seed);
    std::ranges::shuffle(shuffled.fractures, random);
    expect_same(shuffled, 1e-12);
    Geometry disturbed = drawn;
    for (FractureGeometry& trace : disturbed.fractures)
      for (Point& x : trace.points) x *= 1 + 1e-9 * (random() % 3 - 1.0);
    expect_same(disturbed, 1e-7);
    // Joined lines stay as they are.
    Geometry again = joined;
    again.snap.reset();
    EXPECT_THAT(snap_geometry(again, coarse), IsEmpty());
    for (std::size_t f = 0; f < joined.fractures.size(); ++f)
      EXPECT_EQ(again.fractures[f].points, joined.fractures[f].points);
  }
}

/// Where traces meet at 25 degrees or more, what they are drawn beside one another leaves no flat cells. As drawn, the
/// same network has angles of 1e-5 degrees, or none.
TEST(SnapGeometry, DigitizedNetworksHaveGoodMeshes) {
  for (const unsigned seed : {1u, 2u}) {
    const Geometry drawn = digitized_network(60, seed, 25 * degree), joined = snapped(drawn);
    const Mesh mesh = generate_mesh(joined, coarse);
    const double angle = mesh_quality(mesh).smallest_angle / degree;
    std::cout << "smallest angle " << angle << " degrees, " << mesh.cell_count() << " cells\n";
    EXPECT_GT(angle, 5);
    EXPECT_NEAR(total_area(mesh), 1e4, 1e-8);
    EXPECT_NO_THROW(validate_geometry(joined, coarse));
  }
}

TEST(SnapGeometry, KeepsAllBitsOfWhatIsApart) {
  Geometry geometry = box(-1, 3, 0, 2);
  const double third = 1.0 / 3;
  geometry.fractures = {
      fracture("kinked", {{-0.3, 0.3}, {0.2, 0.5}, {0.4, 0.9}}), fracture("side", {{3, 1.2}, {2.2, 1.1}}),
      fracture("through", {{2, 0}, {2.2, 0.5}, {3, 0.6}}), fracture("along", {{1.2, 1.6}, {1.8, 1.6}}),
      fracture("cross", {{1.5, 1.2}, {1.6, 1.8}}),
      // It ends on another one, but for round-off.
      fracture("branch", {{0.2 * third - 0.3 * (1 - third), 0.5 * third + 0.3 * (1 - third)}, {0, 1}})};
  geometry.regions = {region("layer", {{-1, 1.6}, {3, 1.6}, {3, 2}, {-1, 2}}),
                      region("lens", {{0.7, 0.4}, {0.7, 0.9}, {1.5, 0.4}})};
  const Geometry given = geometry;
  EXPECT_THAT(snap_geometry(geometry, {.size = 0.2}), IsEmpty());
  for (std::size_t f = 0; f < given.fractures.size(); ++f)
    EXPECT_EQ(geometry.fractures[f].points, given.fractures[f].points);
  for (std::size_t r = 0; r < given.regions.size(); ++r)
    EXPECT_EQ(geometry.regions[r].polygon, given.regions[r].polygon);
}

/// In a box of 10 m with cells of 0.3 m, joined at 3 mm.
Geometry joined(std::vector<FractureGeometry> fractures, std::optional<double> snap = std::nullopt) {
  Geometry geometry = box(0, 10, 0, 10);
  geometry.fractures = std::move(fractures);
  geometry.snap = snap;
  return snapped(geometry, {.size = 1, .fracture_size = 0.3});
}

TEST(SnapGeometry, EndsAndPointsMoveOntoLines) {
  for (const double off : {1e-12, 1e-9, 1e-7, 1e-5, 1e-3, -1e-9, -1e-7, -1e-5, -1e-3}) {
    // An end beside another line, before it or behind it.
    const Geometry ends = joined({fracture("a", {{2, 5}, {8, 5}}), fracture("b", {{5, 5 + off}, {6, 8}})});
    EXPECT_NEAR(ends.fractures[1].points[0].y(), 5, 1e-11);
    EXPECT_EQ(network(ends).points_with_arms, (std::map<std::size_t, int>{{1, 3}, {3, 1}})) << off;
    // A line beside a bend of another one.
    const Geometry bends =
        joined({fracture("a", {{2, 5}, {5, 5}, {8, 5.5}}), fracture("b", {{5 + off, 3}, {5 + off, 7}})});
    EXPECT_NEAR(bends.fractures[0].points[1].x(), 5 + off, 1e-11);
    EXPECT_EQ(network(bends).points_with_arms, (std::map<std::size_t, int>{{1, 4}, {4, 1}})) << off;
    const Mesh mesh = generate_mesh(bends, {.size = 1, .fracture_size = 0.3});
    EXPECT_GT(mesh_quality(mesh).smallest_angle, 20 * degree) << off;
    EXPECT_EQ(mesh.junctions.size(), 1u);
    // Three lines that nearly meet in a point.
    const Geometry three = joined({fracture("a", {{2, 5}, {8, 5}}), fracture("b", {{3, 3}, {7, 7 + off}}),
                                   fracture("c", {{3 + off, 7}, {7, 3}})});
    EXPECT_EQ(network(three).points_with_arms, (std::map<std::size_t, int>{{1, 6}, {6, 1}})) << off;
    // Two ends.
    const Geometry two = joined({fracture("a", {{2, 5}, {5, 5}}), fracture("b", {{5 + off, 5 - off}, {8, 6}})});
    EXPECT_EQ(network(two).points_with_arms, (std::map<std::size_t, int>{{1, 2}, {2, 1}})) << off;
  }
}

TEST(SnapGeometry, EndsMoveOntoSidesExactly) {
  const Geometry geometry = joined({fracture("a", {{1e-4, 5.0001}, {4, 5}}), fracture("b", {{5, 9.999}, {5, 6}})});
  EXPECT_EQ(geometry.fractures[0].points[0], Point(0, 5.0001));
  EXPECT_EQ(geometry.fractures[1].points[0], Point(5, 10));
  EXPECT_THAT(input_error([] {
                validate_geometry(joined({fracture("a", {{2, 4}, {5, 1e-4}, {8, 4}})}), {});
              }),
              HasSubstr("fracture 'a' touches the boundary between its ends"));
}

TEST(SnapGeometry, PartsThatLieOnOthersAreLeftOut) {
  const FractureGeometry a = fracture("a", {{1, 5}, {8, 5}});
  // The same once more, turned round, and a part of it.
  EXPECT_EQ(joined({a, fracture("b", {{8, 5.0001}, {1, 4.9999}})}).fractures.size(), 1u);
  EXPECT_EQ(joined({fracture("b", {{3, 5.0001}, {5, 4.9999}}), a}).fractures[0].name, "a");
  // Its end.
  const Geometry end = joined({a, fracture("b", {{6, 5.0001}, {8, 5}, {9, 6}})});
  EXPECT_EQ(end.fractures[1].points, (std::vector<Point>{{8, 5}, {9, 6}}));
  // Its middle: it falls apart.
  const Geometry middle =
      joined({a, fracture("b", {{2, 7}, {4, 5.0001}, {6, 4.9999}, {7, 6}}), fracture("b_2", {{1, 1}, {2, 1}})});
  ASSERT_EQ(middle.fractures.size(), 4u);
  std::set<std::string> names;
  for (const FractureGeometry& part : middle.fractures) names.insert(part.name);
  EXPECT_EQ(names, (std::set<std::string>{"a", "b", "b_2", "b_3"}));
  EXPECT_EQ(network(middle).points_with_arms, (std::map<std::size_t, int>{{1, 6}, {3, 2}}));
}

TEST(SnapGeometry, SaysWhatItHasDone) {
  Geometry geometry = box(0, 10, 0, 10);
  geometry.fractures = {fracture("a", {{2, 5}, {8, 5}}), fracture("b", {{5, 5.002}, {6, 8}}),
                        fracture("speck", {{1, 1}, {1.001, 1}}), fracture("double", {{3, 5}, {4, 5}}),
                        fracture("dense", {{1, 8}, {1, 8.001}, {1, 8.002}, {3, 9}})};
  const std::vector<std::string> notes = snap_geometry(geometry, {.size = 1, .fracture_size = 0.3});
  ASSERT_EQ(notes.size(), 1u);
  EXPECT_THAT(notes[0], AllOf(HasSubstr("nearer than 0.003 m"), HasSubstr("by up to 0.002 m at (5, 5)"),
                              HasSubstr("1 m of 1 fracture left out that lay on others"),
                              HasSubstr("of 'double' nothing is left"), HasSubstr("left out: 'speck'"),
                              HasSubstr("geometry.snap")));
  geometry.fractures = {fracture("a", {{2, 5}, {8, 5}}), fracture("b", {{5, 5.002}, {6, 8}})};
  for (const double length : {0.0, 0.001}) {
    geometry.snap = length;
    EXPECT_THAT(snap_geometry(geometry, {.size = 1}), IsEmpty());
  }
  geometry.snap = 0.002;  // as far as the end is
  EXPECT_EQ(snap_geometry(geometry, {.size = 1}).size(), 1u);
  geometry.snap = 1.5;
  EXPECT_THAT(input_error([&] { snap_geometry(geometry, {.size = 1}); }), HasSubstr("lower geometry.snap"));
}

TEST(SnapGeometry, LongLinesAreThinnedOut) {
  Geometry geometry = box(0, 100, 0, 100);
  std::vector<Point> points;
  for (int i = 0; i < 100'000; ++i) points.emplace_back(5 + 9e-4 * i, 50 + 10 * std::sin(1.8e-4 * i));
  geometry.fractures = {fracture("line", points)};
  snap_geometry(geometry, coarse);
  const std::vector<Point>& fewer = geometry.fractures[0].points;
  EXPECT_LT(fewer.size(), 500u);
  EXPECT_EQ(fewer.front(), points.front());
  EXPECT_EQ(fewer.back(), points.back());
  for (std::size_t i = 0; i < points.size(); i += 97) {
    double nearest = 100;
    for (std::size_t k = 0; k + 1 < fewer.size(); ++k)
      nearest = std::min(nearest, distance(points[i], {fewer[k], fewer[k + 1]}));
    ASSERT_LE(nearest, 0.02);
  }
}

/// What lies twice in one line is not left out without a word; a hook no longer than what is joined is.
TEST(SnapGeometry, LinesThatFoldBackAreRefused) {
  const std::vector<std::vector<Point>> folded = {{{10, 10}, {50, 40}, {30, 25}},
                                                  {{10, 10}, {50, 40}, {30, 25.005}},
                                                  {{10, 10}, {50, 40}, {2, 4}},
                                                  {{10, 10}, {30, 25}, {20, 17.5}, {50, 40}},
                                                  {{10, 10}, {30, 25}, {30, 60}, {30, 25}, {50, 20}}};
  for (const std::vector<Point>& points : folded)
    for (const double turn : {0.0, 1.0}) {
      Geometry geometry = box(-100, 100, -100, 100);
      std::vector<Point> turned;
      const double c = std::cos(turn), s = std::sin(turn);
      for (const Point& x : points) turned.emplace_back(c * x[0] - s * x[1], s * x[0] + c * x[1]);
      geometry.fractures.push_back(fracture("hook", turned));
      snap_geometry(geometry, coarse);
      EXPECT_THAT(input_error([&] { validate_geometry(geometry, coarse); }), HasSubstr("'hook' meets itself"));
    }
  Geometry geometry = box(-100, 100, -100, 100);
  geometry.fractures.push_back(fracture("end", {{10, 10}, {50, 40}, {49.975, 39.985}}));
  EXPECT_NEAR(network(snapped(geometry)).length, 50, 0.04);
}

/// Within seconds: the time grows hardly faster than the number of lines.
TEST(SnapGeometry, ManyFracturesAreCheckedTogether) {
  Geometry geometry = box(0, 1000, 0, 1000);
  std::mt19937 random(1);
  const auto draw = [&](double low, double high) {
    return low + (high - low) * (random() / (std::mt19937::max() + 1.0));
  };
  for (int i = 0; i < 5000; ++i) {
    const Point middle(draw(10, 990), draw(10, 990));
    const double angle = draw(0, 6), half = draw(1, 3);
    const Point way = half * Point(std::cos(angle), std::sin(angle));
    geometry.fractures.push_back(fracture("f" + std::to_string(i), {middle - way, middle + way}));
  }
  geometry.fractures.push_back(fracture("f7", {{500, 500}, {1200, 500}}));
  geometry.fractures.push_back(fracture("out", {{500, 500}, {500, -1}}));
  snap_geometry(geometry, {.size = 20, .fracture_size = 2});
  EXPECT_THAT(input_error([&] { validate_geometry(geometry, {.size = 20, .fracture_size = 2}); }),
              AllOf(HasSubstr("two fractures are called 'f7'"), HasSubstr("'f7' leaves the box"),
                    HasSubstr("'out' leaves the box")));
}

}  // namespace
}  // namespace sprekk::test
