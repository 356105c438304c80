// Values between cells: exact for quadratic fields, on the right side of fractures, of third order elsewhere.
#include "framework/discretization/quadratic_fit.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <complex>
#include <functional>

#include "framework/mesh/search/point_location.hpp"
#include "tests/components/meshes.hpp"

namespace sprekk::test {
namespace {

double quadratic(const Point& x) {
  return 3 - 0.7 * x[0] + 2 * x[1] + 1.3 * x[0] * x[0] - 0.4 * x[0] * x[1] - 2.1 * x[1] * x[1];
}

double fitted(const Mesh& mesh, const Point& x, const std::function<double(const Point&)>& field) {
  const auto weights = quadratic_fit(mesh, PointLocation(mesh).cell_at(x), x);
  double value = 0;
  for (const auto& [cell, weight] : weights) value += weight * field(mesh.cell_center[cell]);
  return value;
}

TEST(QuadraticFit, IsExactForQuadraticFields) {
  const Mesh rectangles_with_fractures = fractured_rectangles();
  for (const Mesh& mesh :
       {fractured_square(), rectangles_with_fractures, generate_mesh(box(1, 1), structured(7, 9, 0.2)),
        generate_mesh(box(1, 1), rectangles(6, 6)), generate_mesh(box(1, 1), mixed(0.1, 0.2))})
    for (int i = 0; i < 20; ++i)
      for (int k = 0; k < 20; ++k) {
        const Point x((i + 0.37) / 20, (k + 0.61) / 20);
        // A single row of cells above a fracture, which cannot tell how the field changes across it.
        if (mesh.version == rectangles_with_fractures.version && x.x() < 0.5 && x.y() > 0.9) continue;
        EXPECT_NEAR(fitted(mesh, x, quadratic), quadratic(x), 1e-11) << x.transpose();
      }
}

/// A strip of rectangles of 0.1 m, `rows` wide, 12 long, that is turned about the origin.
Mesh strip(int rows, double turn, bool triangles) {
  constexpr int columns = 12;
  RawMesh raw;
  raw.region_names = {"rock"};
  raw.side_names = {"side"};
  const auto node = [](int i, int j) { return i + (columns + 1) * j; };
  const Point along(std::cos(turn), std::sin(turn)), across(-along.y(), along.x());
  for (int j = 0; j <= rows; ++j)
    for (int i = 0; i <= columns; ++i) raw.nodes.push_back(0.1 * (i * along + j * across));
  for (int j = 0; j < rows; ++j)
    for (int i = 0; i < columns; ++i) {
      const int a = node(i, j), b = node(i + 1, j), c = node(i + 1, j + 1), d = node(i, j + 1);
      if (triangles)
        raw.cells.insert(raw.cells.end(), {{a, b, c}, {a, c, d}});
      else
        raw.cells.push_back({a, b, c, d});
    }
  raw.regions.assign(raw.cells.size(), 0);
  for (int j = 0; j < rows; ++j)
    for (const int i : {0, columns}) raw.boundary_faces.push_back({{node(i, j), node(i, j + 1)}, 0});
  for (int i = 0; i < columns; ++i)
    for (const int j : {0, rows}) raw.boundary_faces.push_back({{node(i, j), node(i + 1, j)}, 0});
  return build_mesh(raw);
}

TEST(QuadraticFit, IsQuadraticAlongAStripOfCells) {
  for (const int rows : {1, 2})
    for (const bool triangles : {false, true})
      for (const double turn : {0.0, 0.5, 1.2, 1.4, 1.6, -2.3}) {
        const Mesh mesh = strip(rows, turn, triangles);
        const Point along(std::cos(turn), std::sin(turn)), across(-along.y(), along.x());
        const auto field = [&](const Point& x) { return 1 + x.dot(along) - 3 * x.dot(along) * x.dot(along); };
        for (const double off : {0.02, 0.5, 0.91})  // of the width
          for (const double s : {0.03, 0.37, 0.6, 1.17}) {
            const Point x = s * along + 0.1 * rows * off * across;
            // Triangles lie in zigzag, whose axes are not quite those of the strip.
            const double allowed = triangles ? 3 * 0.1 * 0.1 / 4 : 1e-11;
            EXPECT_NEAR(fitted(mesh, x, field), field(x), allowed) << rows << " rows, turned by " << turn;
            double sizes = 0;
            for (const auto& [cell, weight] : quadratic_fit(mesh, PointLocation(mesh).cell_at(x), x))
              sizes += std::abs(weight);
            EXPECT_LT(sizes, 6) << rows << " rows, turned by " << turn;
          }
      }
}

TEST(QuadraticFit, DoesNotDependOnTheCellAtANodeOrAFace) {
  for (const Mesh& mesh :
       {generate_mesh(box(1, 1), unstructured(0.2, 0.3)), generate_mesh(box(1, 1), mixed(0.2, 0.3))}) {
    std::vector<double> values;
    for (int i = 0; i < mesh.cell_count(); ++i) values.push_back(std::sin(3.0 * i * i));
    const auto value = [&](int home, const Point& x) {
      double sum = 0;
      for (const auto& [cell, weight] : quadratic_fit(mesh, home, x)) sum += weight * values[cell];
      return sum;
    };
    for (int node = 0; node < mesh.node_count(); ++node)
      for (const int home : mesh.node_cells[node])
        EXPECT_NEAR(value(home, mesh.nodes[node]), value(mesh.node_cells[node][0], mesh.nodes[node]), 1e-9) << node;
    for (std::size_t face = 0; face < mesh.face_center.size(); ++face) {
      const auto& cells = mesh.face_cells[face];
      if (cells[1] == none) continue;
      EXPECT_NEAR(value(cells[0], mesh.face_center[face]), value(cells[1], mesh.face_center[face]), 1e-9) << face;
    }
  }
}

TEST(QuadraticFit, HasTheValueOfTheOnlyCell) {
  const Mesh mesh = grid_of({0, 1}, {0, 1});
  const auto weights = quadratic_fit(mesh, 0, {0.2, 0.9});
  ASSERT_EQ(weights.size(), 1);
  EXPECT_DOUBLE_EQ(weights[0].second, 1);
  EXPECT_TRUE(quadratic_fit(mesh, none, {3, 3}).empty());
}

// Im sqrt(z^2 - a^2), the flow around a sealed fracture, has another sign on each side, up to the ends. Beside the
// middle the fit is of third order; the field's third derivatives there are below 20 / a^2 of its largest value.
TEST(QuadraticFit, DoesNotCrossAFracture) {
  constexpr double half = 0.5;
  for (const double turn : {0.0, 0.6, -1.1}) {
    const Point along(std::cos(turn), std::sin(turn)), up(-along.y(), along.x());
    const auto field = [&](const Point& x) {
      const double sign = x.dot(up) < 0 ? -1 : 1;
      return sign * std::abs(std::sqrt(std::complex<double>(x.dot(along), x.dot(up)) *
                                           std::complex<double>(x.dot(along), x.dot(up)) -
                                       half * half)
                                 .imag());
    };
    Geometry geometry = box(2, 2);
    geometry.box.low = Point(-2, -2);
    FractureGeometry main;
    main.name = "main";
    main.points = {-half * along, half * along};
    geometry.fractures = {main};
    const Mesh mesh = generate_mesh(geometry, {.size = 0.3, .fracture_size = 0.05, .growth = 0.2});
    for (const double side : {-1.0, 1.0}) {
      for (const double x : {-0.3, 0.0, 0.2})
        for (const double y : {0.001, 0.02, 0.1}) {
          const Point at = x * along + side * y * up;
          EXPECT_NEAR(fitted(mesh, at, field), field(at), 20 * std::pow(0.05, 3))
              << at.transpose() << ", turned by " << turn;
        }
      // Next to an end, where the field goes like a root, half a cell is off by no more than the root of that.
      for (const double x : {-0.48, 0.47}) {
        const Point at = x * along + side * 0.002 * up;
        EXPECT_NEAR(fitted(mesh, at, field), field(at), 0.25 * std::abs(field(at))) << at.transpose();
      }
    }
  }
}

// Lines between centres of rectangles pass through nodes of the fracture, and through its ends.
TEST(QuadraticFit, DoesNotLookThroughNodesOfAFracture) {
  for (const int cells : {10, 20, 40}) {
    Geometry geometry = box(1, 1);
    FractureGeometry main;
    main.name = "main";
    main.points = {Point(0.2, 0.5), Point(0.8, 0.5)};
    geometry.fractures = {main};
    const Mesh mesh = generate_mesh(geometry, rectangles(cells, cells));
    for (int i = 0; i < cells; ++i) {
      const double x = (i + 0.5) / cells;
      if (x < 0.2 || x > 0.8) continue;
      for (const double side : {-1.0, 1.0}) {
        const Point at(x, 0.5 + side * 0.5 / cells);
        for (const auto& [cell, weight] : quadratic_fit(mesh, PointLocation(mesh).cell_at(at), at)) {
          const Point& other = mesh.cell_center[cell];
          if (side * (other.y() - 0.5) > 0) continue;
          const double crossing = at.x() + (other.x() - at.x()) * (0.5 - at.y()) / (other.y() - at.y());
          EXPECT_GT(std::abs(crossing - 0.5), 0.3 + 0.1 / cells) << at.transpose() << " of " << cells;
        }
      }
    }
  }
}

}  // namespace
}  // namespace sprekk::test
