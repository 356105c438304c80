#include "framework/linear/entity_graph.hpp"

#include <gtest/gtest.h>

#include "framework/linear/direct/umfpack_solver.hpp"

namespace sprekk::testing {
namespace {

UnknownBlock field(const std::string& name, int first, int components, const std::vector<Point>& places) {
  UnknownBlock block;
  block.name = name;
  block.first = first;
  block.components = components;
  block.entities = static_cast<int>(places.size());
  block.kind = BlockKind::bulk_elliptic;
  block.coordinates.resize(2, block.entities);
  for (int i = 0; i < block.entities; ++i) block.coordinates.col(i) = places[i];
  return block;
}

/// Two fields on a square grid, a scalar and a vector, each joined to both at the place itself and those beside it;
/// diagonally dominant.
LinearSystem two_fields(int width) {
  LinearSystem system;
  std::vector<Point> places;
  for (int i = 0; i < width * width; ++i) places.emplace_back(i % width, i / width);
  const int count = width * width;
  system.blocks = {field("scalar", 0, 1, places), field("vector", count, 2, places)};
  std::vector<Triplet> entries;
  for (int i = 0; i < count; ++i)
    for (int j = 0; j < count; ++j) {
      if ((places[i] - places[j]).norm() > 1.1) continue;
      const int rows[] = {i, count + 2 * i, count + 2 * i + 1}, columns[] = {j, count + 2 * j, count + 2 * j + 1};
      for (int a = 0; a < 3; ++a)
        for (int b = 0; b < 3; ++b)
          entries.emplace_back(rows[a], columns[b], i == j && a == b ? 20.0 : 1.0 / (1 + a + 2 * b));
    }
  system.local.resize(3 * count, 3 * count);
  system.local.setFromTriplets(entries.begin(), entries.end());
  for (int i = 0; i < 3 * count; ++i) system.rows.push_back(i);
  return system;
}

TEST(EntityGraph, JoinsPlacesWhoseUnknownsAreJoined) {
  const LinearSystem system = two_fields(4);
  const EntityGraph graph(system.local, system.blocks);
  ASSERT_EQ(graph.size(), 16);
  const auto neighbours = [&](int i) {
    return std::vector<int>(graph.neighbours().begin() + graph.starts()[i],
                            graph.neighbours().begin() + graph.starts()[i + 1]);
  };
  EXPECT_EQ(neighbours(0), (std::vector{0, 1, 4}));
  EXPECT_EQ(neighbours(5), (std::vector{1, 4, 5, 6, 9}));
  EXPECT_EQ(neighbours(15), (std::vector{11, 14, 15}));
}

TEST(EntityGraph, NumbersAllUnknownsOfAnEntityOneAfterTheOther) {
  const LinearSystem system = two_fields(2);
  const EntityGraph graph(system.local, system.blocks);
  EXPECT_EQ(graph.unknowns_in_order({2, 0, 3, 1}), (std::vector{2, 8, 9, 0, 4, 5, 3, 10, 11, 1, 6, 7}));
}

TEST(EntityGraph, FieldsAtOtherPlacesAndUnknownsWithoutFieldHaveTheirOwn) {
  LinearSystem system = two_fields(2);
  system.blocks[1].coordinates(0, 3) += 0.1;
  EXPECT_EQ(EntityGraph(system.local, system.blocks).size(), 8);
  system.blocks.pop_back();
  EXPECT_EQ(EntityGraph(system.local, system.blocks).size(), 12);
  EXPECT_EQ(EntityGraph(system.local, {}).size(), 12);
}

TEST(EntityGraph, TheSolverThatOrdersByEntitiesHasTheSolution) {
  const LinearSystem system = two_fields(20);
  UmfpackSolver solver;
  ASSERT_TRUE(solver.factor(system).solved);
  const Vector expected = Vector::LinSpaced(1200, -1, 2);
  Vector x;
  ASSERT_TRUE(solver.solve(system.local * expected, x).solved);
  // Of a matrix whose condition is about 3.
  EXPECT_LT((x - expected).lpNorm<Eigen::Infinity>(), 1e-14);
  EXPECT_EQ(solver.counts().orderings, 1);
}

/// The same system with further entries: places within the radius of the middle depend on those next to the middle,
/// too.
LinearSystem felt_from_afar(int width, double radius) {
  LinearSystem system = two_fields(width);
  const Eigen::MatrixXd& places = system.blocks[0].coordinates;
  const int count = width * width;
  const auto from_middle = [&](int i) { return (places.col(i) - Point(width / 2, width / 2)).norm(); };
  std::vector<Triplet> entries;
  for (int i = 0; i < count; ++i)
    for (int j = 0; j < count; ++j)
      if (from_middle(i) < radius && from_middle(j) < 2.5)
        for (int row = 0; row < 2; ++row)
          for (int column = 0; column < 2; ++column)
            entries.emplace_back(count + 2 * i + row, count + 2 * j + column, 1e-2);
  SparseMatrix more(3 * count, 3 * count);
  more.setFromTriplets(entries.begin(), entries.end());
  system.local += more;
  return system;
}

// Ordered by columns alone, the factors have 1.4 to 2 times as many entries, and grow to 2.5 times of that.
TEST(EntityGraph, WhatManyFeelAndDoesNotFeelThemCostsLittle) {
  const auto entries = [](double radius) {
    UmfpackSolver solver;
    EXPECT_TRUE(solver.factor(felt_from_afar(40, radius)).solved);
    return static_cast<double>(solver.factor_entries());
  };
  const double without = entries(0);
  for (const double radius : {5.0, 8.0, 12.0}) EXPECT_LT(entries(radius), 1.4 * without) << radius;
}

}  // namespace
}  // namespace sprekk::testing
