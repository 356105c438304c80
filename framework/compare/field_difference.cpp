#include "framework/compare/field_difference.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>
#include <optional>

#include "framework/compare/scale.hpp"

namespace sprekk {
namespace {

std::size_t at(int i) { return static_cast<std::size_t>(i); }

/// Numbers of regions and fractures have no unit, and are not compared.
bool is_field(const Grid::Values& array) { return array.name.ends_with(']'); }

/// Where values are compared, with the size that each place stands for.
struct Places {
  std::vector<Position> positions;
  std::vector<double> sizes;
};

/// A field at the places: its components, each for all places.
using Components = std::vector<std::vector<double>>;

FieldDifference difference_of(const std::string& name, const Components& field, const Components& other,
                              const Places& places) {
  FieldDifference difference;
  difference.array = name;
  double sum = 0, whole = 0;
  for (std::size_t i = 0; i < places.sizes.size(); ++i) {
    double square = 0;
    for (std::size_t c = 0; c < field.size(); ++c) {
      const double a = field[c][i], b = other[c][i];
      if (std::isfinite(a) != std::isfinite(b)) square = std::numeric_limits<double>::infinity();
      if (std::isfinite(a) && std::isfinite(b)) square += (a - b) * (a - b);
    }
    sum += places.sizes[i] * square;
    whole += places.sizes[i];
    if (!(std::sqrt(square) > difference.largest)) continue;
    difference.largest = std::sqrt(square);
    difference.where = places.positions[i];
  }
  difference.mean_square = whole > 0 ? std::sqrt(sum / whole) : 0;
  return difference;
}

bool is_same_mesh(const Grid& one, const Grid& other) {
  return one.points_per_cell == other.points_per_cell && one.points == other.points && one.cells == other.cells;
}

Components own_components(const Grid::Values& array) {
  Components components(at(array.components));
  for (std::size_t i = 0; i < array.values.size(); ++i) components[i % at(array.components)].push_back(array.values[i]);
  return components;
}

/// Triangles and lines count by their size, points by their parts of the cells around them.
Places own_places(const Grid& grid, Grid::Place place) {
  Places cells, points{grid.points, std::vector<double>(grid.points.size(), 0.0)};
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
    cells.positions.push_back(middle);
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

/// Collects differences. In the end all of one scale family get the same scale.
class Collected {
 public:
  void add(const std::string& name, const Components& field, const Components& other, const Places& places) {
    fields_.push_back(difference_of(name, field, other, places));
    double& width = widths_[scale_family(name)];
    sizes_.push_back(0);
    for (std::size_t c = 0; c < field.size(); ++c) {
      ValueRange range;
      for (const Components* of : {&field, &other})
        for (const double value : (*of)[c]) range.add(value);
      width = std::max(width, range.width());
      sizes_.back() = std::max(sizes_.back(), range.size());
    }
  }
  std::vector<FieldDifference> take() {
    for (std::size_t i = 0; i < fields_.size(); ++i)
      fields_[i].scale = scale_of(widths_[scale_family(fields_[i].array)], sizes_[i]);
    return std::move(fields_);
  }

 private:
  std::vector<FieldDifference> fields_;
  std::vector<double> sizes_;
  std::map<std::string, double> widths_;  // of the families' widest component
};

}  // namespace

GridDifference grid_difference(const Grid& one, const Grid& walls, const Grid& other, const Grid& other_walls) {
  GridDifference result;
  if (one.cell_count() == 0 || other.cell_count() == 0 || one.points_per_cell != other.points_per_cell) return result;
  const auto pairs = common_arrays(one, other);
  result.is_same_mesh = is_same_mesh(one, other);
  Collected collected;
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
  Places places;
  std::vector<int> cells, parts;
  for (int cell = 0; cell < fine.cell_count(); ++cell) {
    const std::optional<int> part = coarse.part_at(fine.centre(cell), fine.group(cell));
    if (!part) {
      ++result.outside;
      continue;
    }
    cells.push_back(cell);
    parts.push_back(*part);
    places.positions.push_back(fine.centre(cell));
    places.sizes.push_back(fine.size(cell));
  }
  result.compared = static_cast<int>(cells.size());
  for (const auto& [array, found] : pairs) {
    const Grid::Values& on_fine = is_first_finer ? *array : *found;
    const Grid::Values& on_coarse = is_first_finer ? *found : *array;
    Components own, sampled;
    for (int c = 0; c < array->components; ++c) {
      const std::vector<double> all = fine.values(on_fine, c);
      own.emplace_back();
      for (const int cell : cells) own.back().push_back(all[at(cell)]);
      sampled.push_back(coarse.values_at(on_coarse, c, places.positions, parts));
    }
    collected.add(array->name, own, sampled, places);
  }
  result.fields = collected.take();
  return result;
}

}  // namespace sprekk
