// Values on the mesh that are written for pictures.
#pragma once

#include <string>

#include "framework/field/field.hpp"

namespace sprekk {

/// A field as it is written. Values are entity-major: component c of entity i is values[i * components + c].
struct OutputField {
  std::string name;  ///< "pore.pressure"
  std::string unit;  ///< SI, "" for a plain number
  Location location;
  int components = 1;
  Vector values;
  bool is_a_choice = false;  ///< numbers of states: a value between two of them means nothing
};

}  // namespace sprekk
