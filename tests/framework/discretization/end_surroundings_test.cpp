#include "framework/discretization/plane/end_surroundings.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <vector>

#include "framework/mesh/plane/planar.hpp"
#include "framework/meshing/generate_mesh.hpp"
#include "tests/framework/mesh/mesh_checks.hpp"

namespace sprekk::test {
namespace {

Point turned(const Point& x, double angle) {
  return {x[0] * std::cos(angle) - x[1] * std::sin(angle), x[0] * std::sin(angle) + x[1] * std::cos(angle)};
}

/// How many nodes of the first segment, without its ends, an end of the second one, which is bent by `bend` degrees,
/// counts as its own.
int undisturbed_behind(double bend, double frame) {
  Geometry geometry = box(-2, 2, -2, 2);
  const Point corner(0, 0), first(-1, 0), last(std::cos(bend * degree), std::sin(bend * degree));
  geometry.fractures = {fracture("bent", {turned(first, frame), corner, turned(last, frame)})};
  MeshOptions options;
  options.size = 0.5;
  options.fracture_size = 0.25;
  const Mesh mesh = generate_mesh(geometry, options);
  const Point direction = turned(last, frame);
  const FractureCell* end = nullptr;
  for (const FractureCell& cell : mesh.fracture_cells)
    if (!end || cell.center.dot(direction) > end->center.dot(direction)) end = &cell;
  int behind = 0, undisturbed = 0;
  for (int node = 0; node < mesh.node_count(); ++node) {
    const Point x = turned(mesh.nodes[node], -frame);
    if (std::abs(x[1]) > 1e-9 || x[0] > -0.1 || x[0] < -0.9) continue;
    ++behind;
    if (is_field_undisturbed(mesh, node, *end)) ++undisturbed;
  }
  EXPECT_GE(behind, 4) << "two walls have a node each";
  return undisturbed == behind ? behind : -undisturbed;
}

// The field of an end goes on behind a bend of less than 10 degrees, to either side and in any frame.
TEST(EndSurroundings, GoOnBehindASlightBend) {
  for (const double frame : {0.0, 0.7, 2.9}) {
    for (const double bend : {0.0, 5.0, 9.5, -9.5})
      EXPECT_GT(undisturbed_behind(bend, frame), 0) << bend << ' ' << frame;
    for (const double bend : {10.5, -10.5, 30.0}) EXPECT_EQ(undisturbed_behind(bend, frame), 0) << bend << ' ' << frame;
  }
}

}  // namespace
}  // namespace sprekk::test
