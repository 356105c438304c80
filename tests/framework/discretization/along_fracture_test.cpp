// Values along fractures: exact for quadratic ones, continuous, and never across a crossing.
#include "framework/discretization/along_fracture.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "framework/mesh/search/point_location.hpp"
#include "tests/components/meshes.hpp"

namespace sprekk::test {
namespace {

FractureGeometry fracture(const std::string& name, const std::vector<Point>& points) {
  FractureGeometry geometry;
  geometry.name = name;
  geometry.points = points;
  return geometry;
}

/// A fracture with a corner, whose cells become shorter towards one end.
Mesh bent() {
  Geometry geometry = box(4, 4);
  geometry.fractures = {fracture("main", {Point(1, 1), Point(2, 1.3), Point(2.6, 2.4)})};
  return generate_mesh(geometry, {.size = 0.4, .fracture_size = 0.15, .tip_size = 0.04, .growth = 0.2});
}

/// How far along the fracture the centres of its cells are, m.
std::vector<double> centres(const Mesh& mesh) {
  std::vector<double> along;
  double length = 0;
  for (const FractureCell& cell : mesh.fracture_cells) {
    along.push_back(length + cell.measure / 2);
    length += cell.measure;
  }
  return along;
}

double value(const Mesh& mesh, const Point& x, const std::vector<double>& values) {
  double sum = 0;
  for (const auto& [cell, weight] : along_fracture(mesh, nearest_fracture_cell(mesh, x), x))
    sum += weight * values[cell];
  return sum;
}

TEST(AlongFracture, IsExactForQuadraticValuesAlsoAroundACorner) {
  const Mesh mesh = bent();
  const std::vector<double> at = centres(mesh);
  std::vector<double> values;
  for (const double s : at) values.push_back(2 - s + 3 * s * s);
  for (int cell = 2; cell + 2 < mesh.fracture_cell_count(); ++cell)
    for (const double part : {-0.5, -0.3, 0.0, 0.21, 0.5}) {
      const FractureCell& home = mesh.fracture_cells[cell];
      const Point along = mesh.ridges[home.ridges[1]].center - mesh.ridges[home.ridges[0]].center;
      const double s = at[cell] + part * home.measure;
      EXPECT_NEAR(value(mesh, home.center + part * along, values), 2 - s + 3 * s * s, 1e-12) << cell << ", " << part;
    }
}

TEST(AlongFracture, IsContinuousAndHasTheValueOfTheCellAtItsCentre) {
  const Mesh mesh = bent();
  std::vector<double> values;
  for (int i = 0; i < mesh.fracture_cell_count(); ++i) values.push_back(std::sin(3.0 * i * i));
  for (int i = 0; i < mesh.fracture_cell_count(); ++i)
    EXPECT_NEAR(value(mesh, mesh.fracture_cells[i].center, values), values[i], 1e-12);
  for (int i = 0; i + 1 < mesh.fracture_cell_count(); ++i) {
    const FractureCell& one = mesh.fracture_cells[i];
    const FractureCell& next = mesh.fracture_cells[i + 1];
    const Point node = mesh.ridges[one.ridges[1]].center;
    constexpr double off = 1e-4;  // farther than what counts as equally near
    const Point before = node + off * (one.center - node), after = node + off * (next.center - node);
    EXPECT_NEAR(value(mesh, before, values), value(mesh, after, values), 20 * off) << i;
  }
}

TEST(AlongFracture, HasTheValueOfTheCellBeyondTheLastCentre) {
  const Mesh mesh = bent();
  const FractureCell& last = mesh.fracture_cells.back();
  const auto weights = along_fracture(mesh, mesh.fracture_cell_count() - 1, mesh.ridges[last.ridges[1]].center);
  ASSERT_EQ(weights.size(), 1);
  EXPECT_EQ(weights[0].second, 1);
}

TEST(AlongFracture, DoesNotCrossAJunction) {
  Geometry geometry = box(4, 4);
  geometry.fractures = {fracture("one", {Point(1, 2), Point(3, 2)}), fracture("two", {Point(2, 1), Point(2, 3)})};
  const Mesh mesh = generate_mesh(geometry, {.size = 0.4, .fracture_size = 0.2});
  for (int i = 0; i < mesh.fracture_cell_count(); ++i) {
    const FractureCell& cell = mesh.fracture_cells[i];
    for (const double part : {-0.4, 0.4}) {
      const Point along = mesh.ridges[cell.ridges[1]].center - mesh.ridges[cell.ridges[0]].center;
      double sum = 0;
      for (const auto& [other, weight] : along_fracture(mesh, i, cell.center + part * along)) {
        sum += weight;
        EXPECT_EQ(mesh.fracture_cells[other].fracture, cell.fracture);
        EXPECT_GT((mesh.fracture_cells[other].center - Point(2, 2)).dot(cell.center - Point(2, 2)), 0);
      }
      EXPECT_NEAR(sum, 1, 1e-14);
    }
  }
}

}  // namespace
}  // namespace sprekk::test
