// Notes on unusual values of properties, which may come from a wrong unit or power of ten.
#pragma once

#include <string>
#include <vector>

#include "framework/assembly/notes.hpp"
#include "framework/config/usual_range.hpp"
#include "framework/scene/places_of_parts.hpp"
#include "framework/scene/scene.hpp"

namespace sprekk {

/// A value that a scene gives to a property with a usual range.
struct PropertyValue {
  std::string name;   ///< of the parameter
  std::string text;   ///< as it is written
  std::string unit;   ///< SI
  double value = 0;   ///< in this unit
  std::string holds;  ///< of an expression: its value, and where and when it has it
  UsualRange usual;
  Origin where;
};

/// The values of all properties with a usual range that a scene gives: numbers, and all parts of a datum (by region, in
/// windows, in tables). For an expression it is the most unusual value in its cells, at the beginning, in the middle
/// and at the end of the time in which it holds.
std::vector<PropertyValue> properties_of(const Scene& scene, const PlacesOfParts& places);

/// Adds a note for each value outside of its range. If all values are of order one, except for widths and
/// transmissivities of fractures, the scene is treated as dimensionless, and gets a single note on those with a unit.
void note_unusual_values(const std::vector<PropertyValue>& properties, Notes& notes);

/// Other units of the number in "40 Pa" with which it would be in the usual range: "40 MPa", "40 GPa"; none for an
/// expression.
std::vector<std::string> usual_with_other_units(const PropertyValue& property);

}  // namespace sprekk
