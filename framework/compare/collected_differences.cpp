#include "framework/compare/collected_differences.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

#include "framework/compare/scale.hpp"

namespace sprekk {
namespace {

FieldDifference difference_of(const std::string& name, const FieldComponents& field, const FieldComponents& other,
                              const ComparedPlaces& places) {
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

}  // namespace

FieldComponents separate_components(const std::vector<double>& values, int components) {
  FieldComponents separate(components);
  for (std::size_t i = 0; i < values.size(); ++i) separate[i % separate.size()].push_back(values[i]);
  return separate;
}

void CollectedDifferences::add(const std::string& name, const FieldComponents& field, const FieldComponents& other,
                               const ComparedPlaces& places) {
  fields_.push_back(difference_of(name, field, other, places));
  double& width = widths_[scale_family(name)];
  sizes_.push_back(0);
  for (std::size_t c = 0; c < field.size(); ++c) {
    ValueRange range;
    for (const FieldComponents* of : {&field, &other})
      for (const double value : (*of)[c]) range.add(value);
    width = std::max(width, range.width());
    sizes_.back() = std::max(sizes_.back(), range.size());
  }
}

std::vector<FieldDifference> CollectedDifferences::take() {
  for (std::size_t i = 0; i < fields_.size(); ++i)
    fields_[i].scale = scale_of(widths_[scale_family(fields_[i].array)], sizes_[i]);
  return std::move(fields_);
}

}  // namespace sprekk
