// Values along a fracture: linear on straight pieces, nothing mixed across kinks, zero at tips where asked.
#include "couplers/two_level/along_fracture.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "tests/components/meshes.hpp"

namespace sprekk::test {
namespace {

using couplers::AlongFracture;

constexpr double rounding = 1e-13;

/// A fracture before the one that is looked at, so that cells do not begin at 0; and that one: two straight pieces, the
/// first of 0.5 m from the boundary on, the second of 0.25 m up to a tip.
struct Case {
  Mesh mesh;
  AlongFracture along;
  Vector values;
};
constexpr double first_length = 0.5, length = 0.75;

Case kinked(bool starts_on_boundary) {
  Geometry geometry = box(1, 1);
  geometry.fractures.resize(2);
  geometry.fractures[0].name = "other";
  geometry.fractures[0].points = {Point(0.2, 0.9), Point(0.6, 0.9)};
  geometry.fractures[1].name = "kinked";
  const Point first(starts_on_boundary ? 0 : 0.1, 0.2), kink = first + first_length * Point(0.8, 0.6);
  geometry.fractures[1].points = {first, kink, kink + (length - first_length) * Point(1, 0)};
  Mesh mesh = generate_mesh(geometry, unstructured(0.06));
  Vector values(2 * mesh.fracture_cell_count());
  for (int i = 0; i < values.size(); ++i) values[i] = std::sin(1 + 3.0 * i);
  AlongFracture along(mesh, 1);
  return {std::move(mesh), std::move(along), std::move(values)};
}

/// Cells of the fracture with the length at which their middle lies.
std::vector<std::pair<int, double>> middles(const Mesh& mesh) {
  std::vector<std::pair<int, double>> result;
  double s = 0;
  for (int i = mesh.fractures[1].first_cell; i < mesh.fractures[1].first_cell + mesh.fractures[1].cell_count; ++i) {
    result.emplace_back(i, s + 0.5 * mesh.fracture_cells[i].length);
    s += mesh.fracture_cells[i].length;
  }
  return result;
}

Point global(const FractureCell& cell, const Point& local) { return local[0] * cell.normal + local[1] * cell.tangent; }

TEST(AlongFracture, IsLinearBetweenCellsOfOneStraightPiece) {
  Case c = kinked(false);
  // Linear functions, another one on each piece.
  const auto local = [](double s) { return s < first_length ? Point(2 - 3 * s, 1 + s) : Point(7 * s, -20 + 5 * s); };
  const auto cells = middles(c.mesh);
  for (const auto& [cell, s] : cells) c.values.segment<2>(2 * cell) = local(s);
  int pairs = 0;
  for (std::size_t i = 0; i + 1 < cells.size(); ++i) {
    const auto& [cell, from] = cells[i];
    const double to = cells[i + 1].second;
    if (from < first_length && to > first_length) continue;
    ++pairs;
    for (const double part : {0.0, 0.1, 0.5, 0.77, 1.0}) {
      const double s = from + part * (to - from);
      EXPECT_LT((c.along.at(s, c.values) - global(c.mesh.fracture_cells[cell], local(s))).norm(), 1e-12) << s;
    }
  }
  EXPECT_EQ(pairs, c.mesh.fractures[1].cell_count - 2);
}

TEST(AlongFracture, IsConstantBeyondTheOutermostCellsOfAPieceAndMixesNothingAcrossAKink) {
  const Case c = kinked(false);
  const auto cells = middles(c.mesh);
  const auto expect_constant = [&](const std::pair<int, double>& cell, double to) {
    const Point value = global(c.mesh.fracture_cells[cell.first], c.values.segment<2>(2 * cell.first));
    for (const double part : {0.0, 0.3, 0.999999})
      EXPECT_LT((c.along.at(cell.second + part * (to - cell.second), c.values) - value).norm(), rounding) << to;
  };
  expect_constant(cells.front(), 0);
  expect_constant(cells.front(), -0.2);  // what has been added at the first point
  expect_constant(cells.back(), length);
  expect_constant(cells.back(), length + 0.2);
  const auto behind = std::find_if(cells.begin(), cells.end(), [](const auto& x) { return x.second > first_length; });
  expect_constant(*(behind - 1), first_length);
  expect_constant(*behind, first_length);
}

TEST(AlongFracture, ReadsItsOwnCellsOnly) {
  Case c = kinked(false);
  const Vector before = c.values;
  const Fracture& other = c.mesh.fractures[0];
  c.values.segment(2 * other.first_cell, 2 * other.cell_count).setConstant(1e30);
  for (double s = 0; s < length; s += 0.01) EXPECT_EQ(c.along.at(s, c.values), c.along.at(s, before));
}

TEST(AlongFracture, VanishesLinearlyAtTips) {
  const Case c = kinked(false);
  const auto cells = middles(c.mesh);
  const auto value = [&](int cell) { return global(c.mesh.fracture_cells[cell], c.values.segment<2>(2 * cell)); };
  for (const double part : {0.0, 0.2, 0.9, 1.0}) {
    const auto& [first, s] = cells.front();
    EXPECT_LT((c.along.jump(part * s, c.values) - part * value(first)).norm(), rounding) << part;
    const auto& [last, t] = cells.back();
    const double from_end = part * (length - t);
    EXPECT_LT((c.along.jump(length - from_end, c.values) - part * value(last)).norm(), rounding) << part;
  }
  for (double s = cells.front().second; s < cells.back().second; s += 0.01)
    EXPECT_EQ(c.along.jump(s, c.values), c.along.at(s, c.values));
  // Ahead of the tips there is nothing.
  EXPECT_EQ(c.along.jump(length + 0.1, c.values).norm(), 0);
  EXPECT_EQ(c.along.jump(-0.1, c.values).norm(), 0);
}

TEST(AlongFracture, DoesNotVanishAtTheOuterBoundary) {
  const Case c = kinked(true);
  for (double s = 0; s < first_length; s += 0.01) EXPECT_EQ(c.along.jump(s, c.values), c.along.at(s, c.values));
  EXPECT_LT(c.along.jump(length, c.values).norm(), rounding);
}

TEST(AlongFracture, OfASingleCellVanishesAtBothTips) {
  Geometry geometry = box(1, 1);
  geometry.fractures.emplace_back();
  geometry.fractures[0].name = "short";
  geometry.fractures[0].points = {Point(0.4, 0.5), Point(0.6, 0.5)};
  const Mesh mesh = generate_mesh(geometry, unstructured(0.2));
  ASSERT_EQ(mesh.fracture_cell_count(), 1);
  const AlongFracture along(mesh, 0);
  const Vector values{{3.0, 4.0}};
  const Point whole = global(mesh.fracture_cells[0], values);
  for (const double part : {0.0, 0.25, 0.5, 0.75, 1.0}) {
    EXPECT_LT((along.at(0.2 * part, values) - whole).norm(), rounding);
    EXPECT_LT((along.jump(0.2 * part, values) - 2 * std::min(part, 1 - part) * whole).norm(), rounding);
  }
}

}  // namespace
}  // namespace sprekk::test
