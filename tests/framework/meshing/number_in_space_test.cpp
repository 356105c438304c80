#include "framework/meshing/number_in_space.hpp"

#include <gmock/gmock.h>

#include <algorithm>
#include <cmath>
#include <numeric>
#include <random>

#include "framework/mesh/order_in_space.hpp"
#include "framework/meshing/generate_mesh.hpp"

namespace sprekk {
namespace {

using testing::Each;
using testing::ElementsAre;
using testing::ElementsAreArray;
using testing::IsEmpty;

std::vector<int> shuffled(int count, unsigned seed) {
  std::vector<int> numbers(count);
  std::iota(numbers.begin(), numbers.end(), 0);
  std::mt19937 random(seed);
  for (int i = count - 1; i > 0; --i) std::swap(numbers[i], numbers[random() % (i + 1)]);
  return numbers;
}

/// 12 x 5 squares, each of two triangles, in two regions, with a fracture along the middle row of nodes.
RawMesh layers() {
  constexpr int nx = 12, ny = 5;
  const auto node = [](int i, int j) { return j * (nx + 1) + i; };
  RawMesh mesh;
  for (int j = 0; j <= ny; ++j)
    for (int i = 0; i <= nx; ++i) mesh.nodes.emplace_back(0.3 * i, 0.2 * j + 0.01 * i);
  mesh.region_names = {"low", "high"};
  mesh.side_names = {"south"};
  for (int j = 0; j < ny; ++j)
    for (int i = 0; i < nx; ++i) {
      mesh.cells.emplace_back(node(i, j), node(i + 1, j), node(i + 1, j + 1));
      mesh.cells.emplace_back(node(i, j), node(i + 1, j + 1), node(i, j + 1));
      mesh.regions.insert(mesh.regions.end(), 2, j < 2 ? 0 : 1);
    }
  for (int i = 0; i < nx; ++i) mesh.boundary_faces.push_back({{node(i, 0), node(i + 1, 0)}, 0});
  mesh.fractures.push_back({"middle", {node(3, 2), node(4, 2), node(5, 2)}});
  return mesh;
}

/// The same with other numbers: node i becomes nodes[i], and so with cells.
RawMesh numbered(const RawMesh& mesh, const std::vector<int>& nodes, const std::vector<int>& cells) {
  RawMesh other = mesh;
  for (std::size_t i = 0; i < nodes.size(); ++i) other.nodes[nodes[i]] = mesh.nodes[i];
  for (std::size_t i = 0; i < cells.size(); ++i) {
    Ring& cell = other.cells[cells[i]] = mesh.cells[i];
    for (int& node : cell) node = nodes[node];
    other.regions[cells[i]] = mesh.regions[i];
  }
  for (auto& edge : other.boundary_faces)
    for (int& node : edge.nodes) node = nodes[node];
  for (auto& fracture : other.fractures)
    for (int& node : fracture.nodes) node = nodes[node];
  return other;
}

void expect_equal(const RawMesh& mesh, const RawMesh& expected) {
  EXPECT_THAT(mesh.nodes, ElementsAreArray(expected.nodes));
  EXPECT_THAT(mesh.cells, ElementsAreArray(expected.cells));
  EXPECT_THAT(mesh.regions, ElementsAreArray(expected.regions));
  EXPECT_THAT(mesh.fractures.at(0).nodes, ElementsAreArray(expected.fractures.at(0).nodes));
  ASSERT_EQ(mesh.boundary_faces.size(), expected.boundary_faces.size());
  for (std::size_t i = 0; i < mesh.boundary_faces.size(); ++i)
    EXPECT_THAT(mesh.boundary_faces[i].nodes, ElementsAreArray(expected.boundary_faces[i].nodes));
}

// What Hilbert's curve is known for: from a square it goes to one of its neighbours.
TEST(OrderInSpace, GoesFromNeighbourToNeighbour) {
  std::vector<Point> points;
  for (const int i : shuffled(16 * 16, 1)) points.emplace_back(3.0 + 0.5 * (i % 16), -7.0 + 0.5 * (i / 16));
  const std::vector<int> order = order_in_space(points);
  ASSERT_THAT(order, testing::UnorderedElementsAreArray(shuffled(16 * 16, 2)));
  std::vector<double> steps;
  for (std::size_t i = 1; i < order.size(); ++i) steps.push_back((points[order[i]] - points[order[i - 1]]).norm());
  EXPECT_THAT(steps, Each(0.5));
}

TEST(OrderInSpace, KeepsTheOrderOfPointsInOnePlace) {
  EXPECT_THAT(order_in_space(std::vector<Point>(4, Point(1, 2))), ElementsAre(0, 1, 2, 3));
  EXPECT_THAT(order_in_space({}), IsEmpty());
}

TEST(NumberInSpace, ChangesNothingButNumbers) {
  const RawMesh before = layers();
  RawMesh mesh = before;
  number_in_space(mesh, mesh.nodes);
  // Where every node and cell went, by position.
  std::vector<int> nodes, cells;
  const auto center = [](const RawMesh& of, int i) {
    Point sum = Point::Zero();
    for (const int node : of.cells[i]) sum += of.nodes[node];
    return sum;
  };
  for (const Point& node : before.nodes)
    nodes.push_back(static_cast<int>(std::find(mesh.nodes.begin(), mesh.nodes.end(), node) - mesh.nodes.begin()));
  for (std::size_t i = 0; i < before.cells.size(); ++i)
    for (std::size_t j = 0; j < mesh.cells.size(); ++j)
      if (center(mesh, j) == center(before, i)) cells.push_back(static_cast<int>(j));
  ASSERT_EQ(cells.size(), before.cells.size());
  EXPECT_NE(mesh.cells, before.cells);
  expect_equal(mesh, numbered(before, nodes, cells));
}

TEST(NumberInSpace, IsTheSameWhateverTheNumbersWere) {
  const RawMesh before = layers();
  RawMesh mesh = before;
  RawMesh other = numbered(before, shuffled(before.nodes.size(), 3), shuffled(before.cells.size(), 4));
  number_in_space(mesh, mesh.nodes);
  number_in_space(other, other.nodes);
  expect_equal(other, mesh);
}

TEST(NumberInSpace, PutsNeighboursOfAGeneratedMeshCloseTogether) {
  Geometry geometry;
  geometry.box.low = Point(0, 0);
  geometry.box.high = Point(1, 1);
  MeshOptions options;
  options.size = 0.02;
  const Mesh mesh = generate_mesh(geometry, options);
  // With a square of the curve for each, they would be one side of the square apart. As gmsh numbers them, it is 14
  // sides from node to node, and 31 from cell to cell.
  const auto mean_step = [](const std::vector<Point>& points) {
    double sum = 0;
    for (std::size_t i = 1; i < points.size(); ++i) sum += (points[i] - points[i - 1]).norm();
    return sum / (points.size() - 1) * std::sqrt(points.size());
  };
  EXPECT_LT(mean_step(mesh.nodes), 1.5);
  EXPECT_LT(mean_step(mesh.cell_center), 1.5);
  EXPECT_LT(mean_step(mesh.face_center), 1.5);  // faces follow their cells
}

}  // namespace
}  // namespace sprekk
