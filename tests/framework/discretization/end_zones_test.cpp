// Zones around the ends of fractures are continuous in the shape of the mesh.
#include "framework/discretization/plane/end_zones.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <set>
#include <string>
#include <utility>

#include "framework/discretization/plane/end_surroundings.hpp"
#include "framework/mesh/build_mesh.hpp"
#include "framework/meshing/generate_mesh.hpp"
#include "tests/framework/mesh/mesh_checks.hpp"

namespace sprekk::test {
namespace {

/// A crack of 2 m, turned by an angle, in a mesh whose part behind `corner` (of -1 to 1 m along the crack) is sheared:
/// so the crack has a bend there (rad).
class BentCrack {
 public:
  BentCrack(double turn, double corner) : along_(std::cos(turn), std::sin(turn)), corner_(corner) {
    Geometry geometry = box(-4, 4, -4, 4);
    geometry.fractures = {fracture("crack", {-along_, corner * along_, along_})};
    const MeshOptions options{.size = 1, .fracture_size = 0.1, .growth = 0.3};
    mesh_ = generate_mesh(geometry, options);
  }

  Mesh with_bend(double bend) const {
    RawMesh raw = to_raw_mesh(mesh_);
    const Point aside(-along_.y(), along_.x());
    for (Point& x : raw.nodes) x += std::tan(bend) * std::max(0.0, x.dot(along_) - corner_) * aside;
    return build_mesh(raw);
  }

 private:
  Point along_;
  double corner_;
  Mesh mesh_;
};

// What lies behind the bend counts smoothly less up to a bend of 3e-3, with a slope of at most 1.5 over this bend.
// Meanwhile nodes move by at most twice the change of the bend, in metres; the field fades out over at least 0.02 m, a
// tenth of the way to the bend, with a slope of at most 1.5 over twice the way.
TEST(EndZones, AreContinuousInABendOfTheFracture) {
  constexpr double size = 2e-5, largest = 1.5 * size / 3e-3 + 1.5 * 2 * 2 * size / 0.02;
  for (const double step : {size, -size})
    for (const double turn : {0.0, 0.4})
      for (const double corner : {-0.8, -0.3, 0.5}) {
        const BentCrack crack(turn, corner);
        EndZones before = end_zones(crack.with_bend(0));
        double total = 0;
        for (int i = 1; i <= 350; ++i) {
          const EndZones zones = end_zones(crack.with_bend(i * step));
          for (std::size_t node = 0; node < zones.weight.size(); ++node) {
            const double change = zones.end[node] == before.end[node]
                                      ? std::abs(zones.weight[node] - before.weight[node])
                                      : std::max(zones.weight[node], before.weight[node]);
            ASSERT_LT(change, largest) << "turned by " << turn << ", corner " << corner << ", bend " << i * step;
            total += change;
          }
          before = zones;
        }
        EXPECT_GT(total, 1) << "turned by " << turn << ", corner " << corner << ", step " << step;
      }
}

/// The same mesh with its nodes in the reverse order.
RawMesh reversed(RawMesh raw) {
  const int count = static_cast<int>(raw.nodes.size());
  const auto other = [count](int node) { return count - 1 - node; };
  std::ranges::reverse(raw.nodes);
  for (Ring& cell : raw.cells)
    for (int& node : cell) node = other(node);
  for (RawMesh::BoundaryFace& edge : raw.boundary_faces)
    for (int& node : edge.nodes) node = other(node);
  for (RawMesh::Chain& chain : raw.fractures)
    for (int& node : chain.nodes) node = other(node);
  return raw;
}

// Weights are the same whatever the order of the nodes, also of bends a little farther away than another fracture.
class EndZonesInAnyOrder : public ::testing::TestWithParam<std::pair<double, double>> {};

TEST_P(EndZonesInAnyOrder, AreTheSame) {
  const auto [turn, bend] = GetParam();
  const Point along(std::cos(turn), std::sin(turn)), aside(-along.y(), along.x());
  Geometry geometry = box(-4, 4, -4, 4);
  geometry.fractures = {
      fracture("crack", {-along, 0.3 * along, along}),
      fracture("other", {along + 0.95 * (0.5 * along + std::sqrt(0.75) * aside), 1.8 * along + 1.8 * aside})};
  const MeshOptions options{.size = 1, .fracture_size = 0.03, .growth = 0.2};
  RawMesh raw = to_raw_mesh(generate_mesh(geometry, options));
  for (Point& x : raw.nodes) x += bend * std::max(0.0, x.dot(along) - 0.3) * aside;
  const Mesh one = build_mesh(raw), two = build_mesh(reversed(raw));
  const EndZones before = end_zones(one), after = end_zones(two);
  const auto weights_at = [](const Mesh& mesh, const EndZones& zones) {
    std::map<std::pair<double, double>, std::multiset<double>> weights;  // nodes on fractures exist once per side
    for (int node = 0; node < mesh.node_count(); ++node)
      weights[{mesh.nodes[node].x(), mesh.nodes[node].y()}].insert(zones.weight[node]);
    return weights;
  };
  const auto here = weights_at(one, before), there = weights_at(two, after);
  ASSERT_EQ(here.size(), there.size());
  int partial = 0;
  for (const auto& [place, weights] : here) {
    EXPECT_EQ(weights, there.at(place)) << place.first << ' ' << place.second;
    for (const double weight : weights) partial += weight > 0 && weight < 1;
  }
  EXPECT_GT(partial, 20);
}

INSTANTIATE_TEST_SUITE_P(TurnedMirroredAndPerturbed, EndZonesInAnyOrder,
                         ::testing::Values(std::pair(0.0, 5e-3), std::pair(0.4, 5e-3), std::pair(0.4, -5e-3),
                                           std::pair(0.4, 5e-3 * (1 + 1e-9))));

TEST(EndZones, OfAStraightCrackMeetInItsMiddle) {
  const Mesh mesh = BentCrack(0.4, 0.5).with_bend(0);
  const EndZones zones = end_zones(mesh);
  const Point along(std::cos(0.4), std::sin(0.4));
  for (const FractureCell& cell : mesh.fracture_cells)
    for (const int node : mesh.face_nodes[cell.faces[0]]) {
      const double place = mesh.nodes[node].dot(along);
      if (std::abs(place) < 0.02) continue;
      ASSERT_NE(zones.end[node], none) << place;
      EXPECT_NEAR((mesh.nodes[zones.end[node]] - (place < 0 ? -along : along).eval()).norm(), 0, 1e-9) << place;
      EXPECT_EQ(zones.weight[node], 1) << place;
    }
}

// Beside n short cracks, an end looks at its neighbours only: with four times as many cracks the work is four times as
// much, and not sixteen.
TEST(EndZones, OfManyCracksLookAtTheirNeighbours) {
  const auto work_per_end = [](int rows) {
    Geometry geometry = box(0, 3 * rows, 0, 3 * rows);
    for (int i = 0; i < rows * rows; ++i) {
      const Point from(3 * (i % rows) + 1, 3 * (i / rows) + 1);
      geometry.fractures.push_back(fracture("crack_" + std::to_string(i), {from, from + Point(1, 0)}));
    }
    const EndZones zones =
        end_zones(generate_mesh(geometry, {.kind = MeshOptions::Kind::structured, .cells = {{3 * rows, 3 * rows}}}));
    EXPECT_EQ(zones.cells.size(), 2 * static_cast<std::size_t>(rows * rows));
    return static_cast<double>(zones.looked_at) / (2 * rows * rows);
  };
  // The square of 16 cells around an end holds parts of 36 cracks with 2 nodes each, or 33 nodes of sides as well.
  EXPECT_LE(work_per_end(20), 36 * 2 + 33);
  EXPECT_LE(work_per_end(40), 36 * 2 + 33);
}

}  // namespace
}  // namespace sprekk::test
