// Values of a grid at places that are not its own.
#pragma once

#include <array>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include "framework/results/grid.hpp"

namespace sprekk {

using Position = std::array<double, 2>;  ///< m

/// The cells of a grid of triangles, quadrilaterals or lines, as its file has them, and what they touch.
class CellSampler {
 public:
  /// `walls`: lines across which nothing is continuous; may be without cells.
  CellSampler(const Grid& grid, const Grid& walls);

  int cell_count() const { return static_cast<int>(cells_.size()); }
  const Position& centre(int cell) const { return cells_[cell].centre; }  ///< of gravity
  double size(int cell) const { return cells_[cell].size; }               ///< m^2, or m of a line
  int group(int cell) const { return cells_[cell].group; }                ///< number of its region, or of its line

  /// Part of the grid (a triangle or a line) at a place: for triangles the one that holds it, for lines the nearest one
  /// of the same group. Nothing outside of the grid.
  std::optional<int> part_at(const Position& place, int group) const;
  /// A component of an array at places of `parts`, see SampledArray.
  std::vector<double> values_at(const Grid::Values& array, int component, const std::vector<Position>& places,
                                const std::vector<int>& parts) const;
  /// A component of an array at the centres of its own cells.
  std::vector<double> values(const Grid::Values& array, int component) const;

 private:
  friend class SampledArray;
  struct Cell {
    Position centre{};
    double size = 0;
    int group = 0;
    std::vector<int> parts, beside;
  };
  void add_parts();
  void join_triangles(const Grid& walls);
  void join_lines();
  void fill_boxes();
  Position corner(int part, int k) const;
  Position nearest_of_line(int part, const Position& place) const;
  std::array<double, 3> shares(int part, const Position& place) const;
  double from_points(const Grid::Values& array, int component, int part, const Position& place) const;

  const Grid& grid_;
  std::vector<Cell> cells_;
  // Square boxes that cover the grid, with the triangles that touch each.
  Position lowest_{};
  double box_ = 1;
  int columns_ = 0, rows_ = 0;
  std::vector<std::vector<int>> in_box_;
};

/// A component of an array at any place of its grid. Values of cells are continued linearly from the centre with the
/// gradient that fits the cells beside best (least squares; not across walls or into another group), unless all are
/// whole numbers. Values of points are linear between them. Grid and array must outlive this object.
class SampledArray {
 public:
  SampledArray(const CellSampler& cells, const Grid::Values& array, int component);
  double at(const Position& place, int part) const;

 private:
  Position gradient(int cell) const;

  const CellSampler& cells_;
  const Grid::Values& array_;
  int component_;
  std::vector<double> own_;  ///< of each cell, at its centre
  bool has_steps_ = false;
  mutable std::map<int, Position> gradients_;
};

}  // namespace sprekk
