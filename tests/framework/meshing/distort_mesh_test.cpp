// Meshes whose nodes are moved at random, and the size of cells that nobody asked for.
#include "framework/meshing/distort_mesh.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "framework/mesh/plane/cell_shape.hpp"
#include "framework/meshing/geometry.hpp"

namespace sprekk {
namespace {

/// Squares with sides of 1 m, turned by an angle.
RawMesh squares(int count, double angle) {
  const Point along(std::cos(angle), std::sin(angle)), across(-along[1], along[0]);
  RawMesh mesh;
  mesh.region_names = {"rock"};
  for (int j = 0; j <= count; ++j)
    for (int i = 0; i <= count; ++i) mesh.nodes.push_back(i * along + j * across);
  for (int j = 0; j < count; ++j)
    for (int i = 0; i < count; ++i) {
      const int first = j * (count + 1) + i;
      mesh.cells.push_back(Ring{first, first + 1, first + count + 2, first + count + 1});
      mesh.regions.push_back(0);
    }
  return mesh;
}

/// The smallest corner of all cells over that of a square, and the part of the inner nodes that have moved.
struct Outcome {
  double smallest, moved;
};

Outcome distorted(double amount, int seed, double angle) {
  constexpr int count = 20;
  const RawMesh before = squares(count, angle);
  RawMesh mesh = before;
  distort_mesh(mesh, amount, seed);
  Outcome outcome{1, 0};
  const double square = smallest_corner_area(before.nodes, before.cells[0]);
  for (const Ring& cell : mesh.cells)
    outcome.smallest = std::min(outcome.smallest, smallest_corner_area(mesh.nodes, cell) / square);
  for (std::size_t n = 0; n < mesh.nodes.size(); ++n)
    if ((mesh.nodes[n] - before.nodes[n]).norm() > 0) outcome.moved += 1. / ((count - 1) * (count - 1));
  return outcome;
}

TEST(DistortMesh, KeepsAFifthOfEachCornerAndMovesNodesAllTheSame) {
  for (const double angle : {0.0, 0.7})
    for (const int seed : {1, 2, 3}) {
      // Moves of a tenth take at most 2 (0.1 + 0.1) of a corner of 1: nothing is halved.
      EXPECT_GT(distorted(0.1, seed, angle).smallest, 0.6);
      for (const double amount : {0.45, 0.9}) {
        const Outcome outcome = distorted(amount, seed, angle);
        EXPECT_GE(outcome.smallest, 0.2 * (1 - 1e-12)) << amount;
        EXPECT_LT(outcome.smallest, 0.3) << amount;  // the bound is reached: larger moves were halved
        EXPECT_GT(outcome.moved, 0.97) << amount;    // by six halves of it a node hardly ever has no room
      }
    }
}

TEST(FarSize, IsAFiftiethOfTheLongerSideUnlessItIsGiven) {
  for (const double scale : {1e-3, 1.0, 1e3})
    for (const Point& size : {Point(3, 1), Point(1, 3)}) {
      Geometry geometry;
      geometry.box.low = Point(-1, 2);
      geometry.box.high = geometry.box.low + scale * size;
      EXPECT_NEAR(far_size(geometry, {}), 0.06 * scale, 1e-14 * scale + 1e-15);
      MeshOptions options;
      options.size = 0.1;
      EXPECT_EQ(far_size(geometry, options), 0.1);
    }
}

}  // namespace
}  // namespace sprekk
