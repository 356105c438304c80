// Differences of fields at places, collected with their scales.
#pragma once

#include <map>
#include <string>
#include <vector>

#include "framework/compare/compared_field.hpp"

namespace sprekk {

/// Where values are compared, with the size that each place stands for.
struct ComparedPlaces {
  std::vector<std::vector<double>> positions;  ///< m, two or three coordinates
  std::vector<double> sizes;
};

/// A field at the places: its components, each for all places.
using FieldComponents = std::vector<std::vector<double>>;

/// The components of values that stand together for each place.
FieldComponents separate_components(const std::vector<double>& values, int components);

/// Collects differences. In the end all of one scale family get the same scale.
class CollectedDifferences {
 public:
  void add(const std::string& name, const FieldComponents& field, const FieldComponents& other,
           const ComparedPlaces& places);
  std::vector<FieldDifference> take();

 private:
  std::vector<FieldDifference> fields_;
  std::vector<double> sizes_;
  std::map<std::string, double> widths_;  // of the families' widest component
};

}  // namespace sprekk
