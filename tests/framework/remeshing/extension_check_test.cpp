#include "framework/remeshing/extension_check.hpp"

#include "framework/mesh/plane/planar.hpp"
#include "framework/meshing/generate_mesh.hpp"
#include "tests/framework/remeshing/growth_checks.hpp"
#include "tests/framework/remeshing/mesh_with_obstacles.hpp"

namespace sprekk::test {
namespace {

using testing::AllOf;
using testing::HasSubstr;
using Reason = ExtensionError::Reason;

constexpr double size = 0.1;

Mesh sample() { return mesh_with_obstacles(size); }

void expect_refused(const std::vector<PathExtension>& extensions, Reason reason, const Point& where,
                    const std::string& words) {
  static const Mesh mesh = sample();
  try {
    check_extensions(mesh, extensions, size);
    ADD_FAILURE() << "was not refused: " << words;
  } catch (const ExtensionError& error) {
    EXPECT_EQ(error.reason(), reason) << error.what();
    EXPECT_NEAR((error.where() - where).norm(), 0, 1e-12) << to_text(error.where()) << ' ' << error.what();
    EXPECT_EQ(error.extension(), static_cast<int>(extensions.size()) - 1);
    EXPECT_THAT(error.what(), AllOf(HasSubstr("cannot be extended"), HasSubstr(words)));
  }
}

TEST(CheckExtensions, AcceptsFreePathsAndPutsEndsOntoTheBoundary) {
  const Mesh mesh = sample();
  const auto checked = check_extensions(
      mesh, {{0, true, {{1.8, 1.2}, {1.9, 1.4}}}, {0, false, {{0.3, 0.4}, {0.0005, 0.33}}}, {1, true, {{2.5, 1.8}}}},
      size);
  EXPECT_EQ(checked[0].points[1], Point(1.9, 1.4));
  EXPECT_EQ(checked[1].points[1].x(), 0);
  EXPECT_NEAR(checked[1].points[1].y(), 0.33, 1e-15);
  // A right angle is just allowed, and half an edge length beside another fracture.
  EXPECT_NO_THROW(check_extensions(mesh, {{0, true, {{1.5, 1.3}}}}, size));
  EXPECT_NO_THROW(check_extensions(mesh, {{0, true, {{2.4499, 1.2}}}}, size));
}

TEST(CheckExtensions, RefusesOtherFractures) {
  expect_refused({{0, true, {{3, 1}}}}, Reason::crosses_fracture, {2.5, 1}, "meets fracture 'wall'");
  // Between two points of the mesh of the other.
  expect_refused({{0, true, {{2.5, 1.25}}}}, Reason::crosses_fracture, {2.5, 1.25}, "meets fracture 'wall'");
  expect_refused({{0, true, {{2.46, 1.2}}}}, Reason::too_near, {2.46, 1.2}, "too near to fracture 'wall'");
  expect_refused({{0, true, {{2, 1.3}, {2.48, 1.54}}}}, Reason::too_near, {2.48, 1.54}, "too near to fracture 'wall'");
}

TEST(CheckExtensions, PutsEndsOntoPointsOfOtherFractures) {
  const Mesh mesh = sample();
  const auto checked = check_extensions(mesh, {{0, true, {{1.8, 1.1}, {2.4995, 1.2005}}}}, size);
  EXPECT_NEAR((checked[0].points[1] - Point(2.5, 1.2)).norm(), 0, 1e-12);
  EXPECT_NO_THROW(check_extensions(mesh, {{0, true, {{2.5, 1.5}}}}, size));               // a tip
  EXPECT_NO_THROW(check_extensions(mesh, {{0, true, {{2.4, 0.65}, {2.5, 0.9}}}}, size));  // at 22 degrees
  expect_refused({{0, true, {{2.46, 1}, {2.5, 1.1}}}}, Reason::too_near, {2.46, 1}, "too near to fracture 'wall'");
  expect_refused({{0, true, {{2.44, 1}, {2.5, 1.3}}}}, Reason::too_near, {2.5, 1.3}, "at less than 15 degrees");
  // Both tips of one fracture may not end at the same place.
  expect_refused({{0, true, {{2.5, 1.2}}}, {2, false, {{2.5, 1.2}}}}, Reason::crosses_fracture, {2.5, 1.2},
                 "meets the extension of fracture 'main'");
}

TEST(CheckExtensions, RefusesItself) {
  expect_refused({{0, true, {{1.7, 0.9}, {1.6, 0.7}, {1.4, 0.8}, {1.3, 1.2}}}}, Reason::crosses_fracture, {1.35, 1},
                 "meets itself");
  expect_refused({{0, true, {{1.7, 1.2}, {1.9, 1.2}, {1.9, 1.4}, {1.75, 1.4}, {1.75, 1.1}}}}, Reason::crosses_fracture,
                 {1.75, 1.2}, "meets itself");
  expect_refused({{0, true, {{1.5, 1.2}, {1.3, 1.2}, {1.3, 1.04}}}}, Reason::too_near, {1.3, 1.04},
                 "too near to itself");
  // The two ends of one fracture run into each other.
  expect_refused({{0, true, {{1.8, 1.3}}}, {0, false, {{0.3, 0.4}, {0.2, 0.6}, {0.3, 1.2}, {1.7, 1.27}}}},
                 Reason::too_near, {1.7, 1.27}, "the extension of fracture 'main'");
}

TEST(CheckExtensions, RefusesOtherExtensions) {
  expect_refused({{0, true, {{2, 1}}}, {1, false, {{2.2, 0.4}, {1.8, 1.2}}}}, Reason::crosses_fracture, {1.9, 1},
                 "the extension of fracture 'main'");
}

TEST(CheckExtensions, RefusesTheOutside) {
  expect_refused({{0, true, {{1.5, 2.5}}}}, Reason::leaves_mesh, {1.5, 2}, "leaves the mesh");
  expect_refused({{0, true, {{1.5, 1.5}, {1.6, 2.1}, {2, 2.2}}}}, Reason::leaves_mesh, {1.5 + 5. / 60, 2},
                 "leaves the mesh");
  expect_refused({{0, true, {{1.7, 1.97}}}}, Reason::too_near, {1.7, 1.97}, "too near to the outer boundary");
  expect_refused({{0, true, {{1.7, 1.93}, {2.5, 2}}}}, Reason::too_near, {2.5, 2}, "less than 15 degrees");
}

TEST(CheckExtensions, RefusesWhatIsNoPath) {
  expect_refused({{0, true, {}}}, Reason::no_path, {1.5, 1}, "no new point");
  expect_refused({{0, true, {{1.5, 1}}}}, Reason::no_path, {1.5, 1}, "without length");
  expect_refused({{0, true, {{1.6, std::nan("")}}}}, Reason::no_path, {1.5, 1}, "no number");
  expect_refused({{0, true, {{1.4, 1.2}}}}, Reason::turns_back, {1.5, 1}, "by more than 90 degrees");
  expect_refused({{0, true, {{1.8, 1}, {1.7, 1.2}}}}, Reason::turns_back, {1.8, 1}, "turns back");
  expect_refused({{2, true, {{4.1, 1}}}}, Reason::no_tip, {4, 1}, "already ends");
  expect_refused({{0, true, {{1.6, 1}}}, {0, true, {{1.6, 1.1}}}}, Reason::no_tip, {1.5, 1}, "extended twice");
  EXPECT_THROW(check_extensions(sample(), {{3, true, {{1, 1}}}}, size), std::invalid_argument);
}

/// Of a path that goes on from the end of "main" in an arc of this radius (m) and turn (rad), in steps of 2 degrees.
PathExtension arc(double radius, double turn) {
  constexpr double step = 2 * degree;
  PathExtension path{0, true, {}};
  for (int i = 1; i * step <= turn; ++i)
    path.points.emplace_back(1.5 + radius * std::sin(i * step), 1 + radius * (1 - std::cos(i * step)));
  return path;
}

bool is_accepted(const Mesh& mesh, const PathExtension& path) {
  try {
    check_extensions(mesh, {path}, size);
    return true;
  } catch (const ExtensionError&) {
    return false;
  }
}

// An arc that has turned by t is r (1 - cos t) above the fracture that it left, at r t along the way: a quarter of the
// way at t = 262 degrees.
TEST(CheckExtensions, RefusesALoopThatComesBackWithinAQuarterOfItsWay) {
  const Mesh mesh = sample();
  for (const double radius : {0.01, 0.03}) {
    EXPECT_TRUE(is_accepted(mesh, arc(radius, 258 * degree))) << radius;
    EXPECT_FALSE(is_accepted(mesh, arc(radius, 266 * degree))) << radius;
  }
}

// A tip stands beside the end of another fracture, at less than half an edge. A path that leaves it at an angle towards
// the other comes nearer by the cosine of the angle, which is 0.9 at 26 degrees.
TEST(CheckExtensions, LetsATipThatIsNearAFractureAlreadyGoOnPastIt) {
  constexpr double away = 0.3 * size;
  for (const double turn : {0.0, 0.7}) {
    const auto at = [&](double x, double y) { return turned(Point(x, y), turn); };
    Geometry geometry = box(-4, 4, -4, 4);
    geometry.fractures = {fracture("main", {at(0, 0), at(1, 0)}), fracture("wall", {at(0.5, -away), at(1, -away)})};
    const Mesh mesh = generate_mesh(geometry, {.size = 1, .fracture_size = size});
    const auto down_by = [&](double angle) {
      return PathExtension{0, true, {at(1 + size * std::cos(angle), -size * std::sin(angle))}};
    };
    EXPECT_TRUE(is_accepted(mesh, down_by(0))) << turn;
    EXPECT_TRUE(is_accepted(mesh, down_by(24 * degree))) << turn;
    EXPECT_FALSE(is_accepted(mesh, down_by(28 * degree))) << turn;
    EXPECT_TRUE(is_accepted(mesh, down_by(-30 * degree))) << turn;
  }
}

// Paths may end half an edge before a fracture; a tip stops where another half of that is left.
TEST(ComesTooNear, WhereAThirdOfTheGapIsLeftAboveWhatIsRefused) {
  const Mesh mesh = sample();
  const Point beginning(1.5, 1), from(2.3, 1);
  const auto is_too_near = [&](double gap) {
    return comes_too_near(mesh, 0, beginning, from, {2.5 - gap * size, 1}, size);
  };
  const auto is_path = [&](double gap) { return is_accepted(mesh, {0, true, {from, {2.5 - gap * size, 1}}}); };
  EXPECT_FALSE(is_too_near(0.77));
  EXPECT_TRUE(is_too_near(0.73));
  EXPECT_TRUE(is_path(0.51));
  EXPECT_FALSE(is_path(0.49));
}

}  // namespace
}  // namespace sprekk::test
