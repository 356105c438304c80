// Values along a fracture: linear on straight pieces, nothing mixed across kinks, zero at tips where asked.
#include "couplers/two_level/plane/along_fracture.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>

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
    result.emplace_back(i, s + 0.5 * mesh.fracture_cells[i].measure);
    s += mesh.fracture_cells[i].measure;
  }
  return result;
}

Point global(const FractureCell& cell, const Point& local) { return local[0] * cell.normal + local[1] * cell.tangents; }

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

/// Two fractures that cross in (0.5, 0.5), the first one straight, and one that ends there.
Mesh crossing() {
  Geometry geometry = box(1, 1);
  geometry.fractures.resize(3);
  geometry.fractures[0].name = "a";
  geometry.fractures[0].points = {Point(0.1, 0.5), Point(0.5, 0.5), Point(0.9, 0.5)};
  geometry.fractures[1].name = "b";
  geometry.fractures[1].points = {Point(0.6, 0.9), Point(0.5, 0.5), Point(0.3, 0.1)};
  geometry.fractures[2].name = "c";
  geometry.fractures[2].points = {Point(0.5, 0.5), Point(0.9, 0.8)};
  return generate_mesh(geometry, unstructured(0.06));
}
const Point where_they_cross(0.5, 0.5);

/// The sector between the fractures, by the angle around the crossing.
int sector(const Mesh& mesh, const Point& x) {
  const auto angle = [](const Point& y) {
    const double a = std::atan2(y[1] - 0.5, y[0] - 0.5);
    return a < -1e-9 ? a + 2 * std::numbers::pi : a;
  };
  int count = 0;
  for (const FractureCell& cell : mesh.fracture_cells)
    for (const Junction& junction : mesh.junctions)
      if (std::find(junction.cells.begin(), junction.cells.end(), &cell - mesh.fracture_cells.data()) !=
          junction.cells.end())
        count += angle(cell.center) < angle(x) ? 1 : 0;
  return count;
}

/// Each sector of the rock has a displacement of its own, linear or constant; the jumps of cells are what they leave.
Point displacement(int sector, const Point& x, bool is_linear) {
  const double k = sector;
  const Point shift(std::sin(k), std::cos(3 * k));
  return is_linear ? Point(shift + Point(k * x[0] - x[1], (2 - k) * x[1] + x[0])) : shift;
}
Point jump_at(const Mesh& mesh, const FractureCell& cell, const Point& x, bool is_linear) {
  const Point off = 0.01 * cell.normal;
  return displacement(sector(mesh, cell.center + off), x, is_linear) -
         displacement(sector(mesh, cell.center - off), x, is_linear);
}

TEST(AlongFracture, MixesNothingAcrossAJunction) {
  const Mesh mesh = crossing();
  ASSERT_EQ(mesh.junctions.size(), 1u);
  const AlongFracture along(mesh, 0);
  Vector values(2 * mesh.fracture_cell_count());
  for (int i = 0; i < mesh.fractures[0].cell_count; ++i) {
    const bool is_before = mesh.fracture_cells[i].center[0] < where_they_cross[0];
    values.segment<2>(2 * i) = is_before ? Point(3, 1) : Point(-5, 2);
  }
  for (double s = 0.005; s < 0.8; s += 0.01) {
    const Point expected = global(mesh.fracture_cells[0], s < 0.4 ? Point(3, 1) : Point(-5, 2));
    EXPECT_LT((along.at(s, values) - expected).norm(), rounding) << s;
  }
}

TEST(AlongFracture, JumpsTowardsAJunctionAreExactForLinearDisplacements) {
  const Mesh mesh = crossing();
  for (const bool is_linear : {false, true}) {
    Vector values(2 * mesh.fracture_cell_count());
    for (int i = 0; i < mesh.fracture_cell_count(); ++i) {
      const FractureCell& cell = mesh.fracture_cells[i];
      const Point jump = jump_at(mesh, cell, cell.center, is_linear);
      values.segment<2>(2 * i) = Point(jump.dot(cell.normal), jump.dot(cell.tangents));
    }
    int looked_at = 0;
    for (int f = 0; f < 3; ++f) {
      const AlongFracture along(mesh, f);
      double s = 0;
      for (int i = 0; i < mesh.fractures[f].cell_count; ++i) {
        const FractureCell& cell = mesh.fracture_cells[mesh.fractures[f].first_cell + i];
        for (const double part : {1e-9, 0.2, 0.7, 1 - 1e-9}) {
          const Point x = cell.center + (part - 0.5) * cell.measure * cell.tangents;
          if ((x - where_they_cross).norm() > 0.1) continue;  // away from tips, where it vanishes
          ++looked_at;
          EXPECT_LT((along.jump(s + part * cell.measure, values) - jump_at(mesh, cell, x, is_linear)).norm(), 1e-8);
        }
        s += cell.measure;
      }
    }
    EXPECT_GT(looked_at, 20);
  }
}

TEST(AlongFracture, JumpsAroundAJunctionAddUpToZero) {
  const Mesh mesh = crossing();
  Vector values(2 * mesh.fracture_cell_count());
  for (int i = 0; i < values.size(); ++i) values[i] = std::sin(1 + 3.0 * i);
  Point sum = Point::Zero();
  double largest = 0;
  for (const int i : mesh.junctions[0].cells) {
    const FractureCell& cell = mesh.fracture_cells[i];
    const AlongFracture along(mesh, cell.fracture);
    double s = 0;
    for (int k = mesh.fractures[cell.fracture].first_cell; k < i; ++k) s += mesh.fracture_cells[k].measure;
    const bool leads_there = (where_they_cross - cell.center).dot(cell.tangents) > 0;
    const Point jump = along.jump(s + (leads_there ? 1 - 1e-13 : 1e-13) * cell.measure, values);
    // From the right of the way out of the junction to its left.
    sum += leads_there ? jump : Point(-jump);
    largest = std::max(largest, jump.norm());
    // The middle of the cell keeps its own.
    EXPECT_LT((along.jump(s + 0.5 * cell.measure, values) - global(cell, values.segment<2>(2 * i))).norm(), rounding);
  }
  EXPECT_GT(largest, 0.1);
  EXPECT_LT(sum.norm(), 1e-11);
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
