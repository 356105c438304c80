#include "framework/mesh/extend_fractures.hpp"

#include "framework/mesh/generate_mesh.hpp"
#include "framework/mesh/mesh_quality.hpp"
#include "tests/framework/mesh/growth_checks.hpp"

namespace sprekk::test {
namespace {

constexpr double size = 0.02;
constexpr CavityOptions usual{.radius = 5 * size, .size = size, .growth = 0.3};

/// A box of 2 m with the paper's kind of fracture, edges of `size` at it.
Mesh one_fracture(std::vector<Point> points = {{0.9, 0.9}, {1.1, 1.1}}) {
  Geometry geometry = box(0, 2, 0, 2);
  geometry.fractures = {fracture("main", std::move(points))};
  return generate_mesh(geometry, {.size = 0.1, .fracture_size = size});
}

TEST(ExtendFractures, StraightOn) {
  const Mesh mesh = one_fracture();
  for (const bool at_end : {true, false}) {
    const GrownMesh grown = extend_fractures(mesh, {straight(mesh, 0, at_end, 2 * size)}, usual);
    expect_sound(mesh, grown);
    EXPECT_EQ(grown.extension_cells[0].size(), 2u);
    EXPECT_GE(grown.smallest_angle, 25 * degree);
    EXPECT_NEAR((tip(grown.mesh, 0, at_end) - tip(mesh, 0, at_end)).norm(), 2 * size, 1e-14);
    EXPECT_EQ(tip(grown.mesh, 0, !at_end), tip(mesh, 0, !at_end));
  }
}

TEST(ExtendFractures, KinksAndLengths) {
  const Mesh mesh = one_fracture();
  double worst = 10;
  for (const double angle : {-75.0, -50.0, -20.0, 0.0, 35.0, 75.0}) {
    for (const double length : {0.5, 1.0, 3.0, 10.0}) {
      const GrownMesh grown = extend_fractures(mesh, {straight(mesh, 0, true, length * size, angle * degree)}, usual);
      expect_sound(mesh, grown);
      worst = std::min(worst, grown.smallest_angle);
    }
  }
  EXPECT_GE(worst, 20 * degree);
}

}  // namespace
}  // namespace sprekk::test
