// Grids for tests: a square that is cut into triangles, turned by an angle, with values of a function.
#pragma once

#include <cmath>
#include <functional>

#include "framework/results/grid.hpp"

namespace sprekk {

using Function = std::function<double(double, double)>;

/// A square [0, 1]^2 of n x n pairs of triangles, whose inner points are moved a little, turned by `angle`.
inline Grid square(int n, double angle, double shake) {
  Grid grid;
  grid.points_per_cell = 3;
  for (int j = 0; j <= n; ++j)
    for (int i = 0; i <= n; ++i) {
      const bool is_inner = i > 0 && j > 0 && i < n && j < n;
      const double x = (i + (is_inner ? shake * std::sin(3.0 * i + 5.0 * j) : 0.0)) / n;
      const double y = (j + (is_inner ? shake * std::cos(7.0 * i + 2.0 * j) : 0.0)) / n;
      grid.points.push_back({x * std::cos(angle) - y * std::sin(angle), x * std::sin(angle) + y * std::cos(angle)});
    }
  for (int j = 0; j < n; ++j)
    for (int i = 0; i < n; ++i) {
      const int a = j * (n + 1) + i;
      grid.cells.insert(grid.cells.end(), {a, a + 1, a + n + 2, a, a + n + 2, a + n + 1});
    }
  for (int i = 0; i < 2 * n * n; ++i) grid.sources.push_back(i);
  return grid;
}

inline Grid line(const std::vector<std::array<double, 2>>& points) {
  Grid grid;
  grid.points_per_cell = 2;
  grid.points = points;
  for (int i = 0; i + 1 < static_cast<int>(points.size()); ++i) {
    grid.cells.insert(grid.cells.end(), {i, i + 1});
    grid.sources.push_back(i);
  }
  grid.arrays.push_back({"fracture", Grid::Place::cell, 1, std::vector<double>(grid.sources.size(), 0.0)});
  return grid;
}

/// Values at the centres of the cells.
inline void add_on_cells(Grid& grid, const std::string& name, const Function& f) {
  Grid::Values values{name, Grid::Place::cell, 1, {}};
  for (int cell = 0; cell < grid.cell_count(); ++cell) {
    double x = 0, y = 0;
    for (int k = 0; k < grid.points_per_cell; ++k) {
      const auto& point =
          grid.points[static_cast<std::size_t>(grid.cells[static_cast<std::size_t>(grid.points_per_cell * cell + k)])];
      x += point[0] / grid.points_per_cell;
      y += point[1] / grid.points_per_cell;
    }
    values.values.push_back(f(x, y));
  }
  grid.arrays.push_back(values);
}

inline void add_on_points(Grid& grid, const std::string& name, const Function& f) {
  Grid::Values values{name, Grid::Place::point, 1, {}};
  for (const auto& point : grid.points) values.values.push_back(f(point[0], point[1]));
  grid.arrays.push_back(values);
}

}  // namespace sprekk
