#include "framework/compare/body_difference.hpp"

#include <Eigen/Core>
#include <algorithm>
#include <optional>
#include <utility>

#include "framework/compare/collected_differences.hpp"
#include "framework/results/bodies.hpp"

namespace sprekk {
namespace {

std::vector<double> along(const Eigen::Vector3d& place) { return {place.x(), place.y(), place.z()}; }

/// Pairs of arrays that have one name and number of components. Numbers of regions and fractures have no unit.
std::vector<std::pair<const GridData::Array*, const GridData::Array*>> common_arrays(
    const std::vector<GridData::Array>& one, const std::vector<GridData::Array>& other) {
  std::vector<std::pair<const GridData::Array*, const GridData::Array*>> pairs;
  for (const GridData::Array& array : one) {
    const auto found = std::ranges::find(other, array.name, &GridData::Array::name);
    if (found != other.end() && array.name.ends_with(']') && found->components == array.components)
      pairs.emplace_back(&array, &*found);
  }
  return pairs;
}

/// Bodies count by their volume, surfaces and points alike.
ComparedPlaces places_of_cells(const GridData& grid) {
  ComparedPlaces places;
  if (grid.cell_dimension == 3) {
    const Bodies bodies(grid);
    for (int body = 0; body < bodies.count(); ++body) {
      places.positions.push_back(along(bodies.centre(body)));
      places.sizes.push_back(bodies.volume(body));
    }
    return places;
  }
  std::int64_t begin = 0;
  for (const std::int64_t end : grid.cell_ends) {
    Eigen::Vector3d middle = Eigen::Vector3d::Zero();
    for (std::int64_t k = begin; k < end; ++k)
      middle += Eigen::Vector3d::Map(&grid.points[3 * grid.cell_points[k]]) / static_cast<double>(end - begin);
    places.positions.push_back(along(middle));
    begin = end;
  }
  places.sizes.assign(places.positions.size(), 1.0);
  return places;
}

ComparedPlaces places_of_points(const GridData& grid) {
  ComparedPlaces places;
  for (int i = 0; i < grid.point_count(); ++i)
    places.positions.push_back(along(Eigen::Vector3d::Map(&grid.points[3 * i])));
  places.sizes.assign(places.positions.size(), 1.0);
  return places;
}

void compare_at_centres(const GridData& one, const GridData& other, GridDifference& result,
                        CollectedDifferences& collected) {
  const bool is_first_finer = one.cell_count() >= other.cell_count();
  const Bodies fine(is_first_finer ? one : other), coarse(is_first_finer ? other : one);
  ComparedPlaces places;
  std::vector<std::pair<int, int>> pairs;  // of bodies of the finer and the coarser mesh
  for (int body = 0; body < fine.count(); ++body) {
    const std::optional<int> there = coarse.holding(fine.centre(body));
    if (!there) {
      ++result.outside;
      continue;
    }
    pairs.emplace_back(body, *there);
    places.positions.push_back(along(fine.centre(body)));
    places.sizes.push_back(fine.volume(body));
  }
  result.compared = static_cast<int>(pairs.size());
  for (const auto& [array, found] : common_arrays(one.on_cells, other.on_cells)) {
    FieldComponents own(array->components), sampled(array->components);
    const GridData::Array &on_fine = is_first_finer ? *array : *found, &on_coarse = is_first_finer ? *found : *array;
    const FieldComponents of_fine = separate_components(on_fine.values, array->components),
                          of_coarse = separate_components(on_coarse.values, array->components);
    for (int c = 0; c < array->components; ++c)
      for (const auto& [body, there] : pairs) {
        own[c].push_back(of_fine[c][body]);
        sampled[c].push_back(coarse.value_at(of_coarse[c], there, fine.centre(body)));
      }
    collected.add(array->name, own, sampled, places);
  }
}

}  // namespace

GridDifference body_difference(const GridData& one, const GridData& other) {
  GridDifference result;
  if (one.cell_count() == 0 || other.cell_count() == 0 || one.cell_dimension != other.cell_dimension) return result;
  result.is_same_mesh =
      one.points == other.points && one.cell_points == other.cell_points && one.cell_ends == other.cell_ends;
  CollectedDifferences collected;
  if (result.is_same_mesh) {
    result.compared = one.cell_count();
    for (const bool on_cells : {true, false}) {
      const auto& arrays = on_cells ? one.on_cells : one.on_points;
      const ComparedPlaces places = on_cells ? places_of_cells(one) : places_of_points(one);
      for (const auto& [array, found] : common_arrays(arrays, on_cells ? other.on_cells : other.on_points))
        collected.add(array->name, separate_components(array->values, array->components),
                      separate_components(found->values, array->components), places);
    }
  } else if (one.cell_dimension == 3) {
    compare_at_centres(one, other, result, collected);
  }
  result.fields = collected.take();
  return result;
}

}  // namespace sprekk
