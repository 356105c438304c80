#include "framework/compare/field_difference.hpp"

#include <algorithm>
#include <cmath>
#include <optional>

#include "framework/compare/collected_differences.hpp"

namespace sprekk {
namespace {

std::size_t at(int i) { return static_cast<std::size_t>(i); }

/// Numbers of regions and fractures have no unit, and are not compared.
bool is_field(const Grid::Values& array) { return array.name.ends_with(']'); }

std::vector<double> along(const Position& place) { return {place[0], place[1]}; }

bool is_same_mesh(const Grid& one, const Grid& other) {
  return one.points_per_cell == other.points_per_cell && one.points == other.points && one.cells == other.cells;
}

FieldComponents own_components(const Grid::Values& array) {
  return separate_components(array.values, array.components);
}

/// Triangles and lines count by their size, points by their parts of the cells around them.
ComparedPlaces own_places(const Grid& grid, Grid::Place place) {
  ComparedPlaces cells, points{{}, std::vector<double>(grid.points.size(), 0.0)};
  for (const Position& point : grid.points) points.positions.push_back(along(point));
  const auto count = at(grid.points_per_cell);
  for (std::size_t cell = 0; cell < at(grid.cell_count()); ++cell) {
    const auto corner = [&](std::size_t k) { return grid.points[at(grid.cells[count * cell + k])]; };
    const Position a = corner(0), b = corner(1), c = corner(count - 1);
    const double x = b[0] - a[0], y = b[1] - a[1];
    cells.sizes.push_back(count == 2 ? std::hypot(x, y) : std::abs(x * (c[1] - a[1]) - y * (c[0] - a[0])) / 2);
    Position middle{};
    for (std::size_t k = 0; k < count; ++k) {
      points.sizes[at(grid.cells[count * cell + k])] += cells.sizes.back() / static_cast<double>(count);
      for (const std::size_t axis : {0U, 1U}) middle[axis] += corner(k)[axis] / static_cast<double>(count);
    }
    cells.positions.push_back(along(middle));
  }
  return place == Grid::Place::cell ? cells : points;
}

/// Pairs of arrays that have one name, place and number of components.
std::vector<std::pair<const Grid::Values*, const Grid::Values*>> common_arrays(const Grid& one, const Grid& other) {
  std::vector<std::pair<const Grid::Values*, const Grid::Values*>> pairs;
  for (const Grid::Values& array : one.arrays) {
    const Grid::Values* const found = other.find(array.name);
    if (found != nullptr && is_field(array) && found->components == array.components) pairs.emplace_back(&array, found);
  }
  return pairs;
}

}  // namespace

GridDifference grid_difference(const Grid& one, const Grid& walls, const Grid& other, const Grid& other_walls) {
  GridDifference result;
  if (one.cell_count() == 0 || other.cell_count() == 0 || one.points_per_cell != other.points_per_cell) return result;
  const auto pairs = common_arrays(one, other);
  result.is_same_mesh = is_same_mesh(one, other);
  CollectedDifferences collected;
  if (result.is_same_mesh) {
    result.compared = one.sources.back() + 1;
    for (const auto& [array, found] : pairs)
      if (array->place == found->place)
        collected.add(array->name, own_components(*array), own_components(*found), own_places(one, array->place));
    result.fields = collected.take();
    return result;
  }
  const bool is_first_finer = one.sources.back() >= other.sources.back();
  const CellSampler fine(is_first_finer ? one : other, is_first_finer ? walls : other_walls);
  const CellSampler coarse(is_first_finer ? other : one, is_first_finer ? other_walls : walls);
  ComparedPlaces places;
  std::vector<Position> positions;
  std::vector<int> cells, parts;
  for (int cell = 0; cell < fine.cell_count(); ++cell) {
    const std::optional<int> part = coarse.part_at(fine.centre(cell), fine.group(cell));
    if (!part) {
      ++result.outside;
      continue;
    }
    cells.push_back(cell);
    parts.push_back(*part);
    positions.push_back(fine.centre(cell));
    places.positions.push_back(along(fine.centre(cell)));
    places.sizes.push_back(fine.size(cell));
  }
  result.compared = static_cast<int>(cells.size());
  for (const auto& [array, found] : pairs) {
    const Grid::Values& on_fine = is_first_finer ? *array : *found;
    const Grid::Values& on_coarse = is_first_finer ? *found : *array;
    FieldComponents own, sampled;
    for (int c = 0; c < array->components; ++c) {
      const std::vector<double> all = fine.values(on_fine, c);
      own.emplace_back();
      for (const int cell : cells) own.back().push_back(all[at(cell)]);
      sampled.push_back(coarse.values_at(on_coarse, c, positions, parts));
    }
    collected.add(array->name, own, sampled, places);
  }
  result.fields = collected.take();
  return result;
}

}  // namespace sprekk
