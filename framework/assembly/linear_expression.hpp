// A quantity that depends linearly on fields: value = constant + sum of matrix · field.
#pragma once

#include <vector>

#include "framework/assembly/operator.hpp"
#include "framework/field/field.hpp"
#include "framework/types.hpp"

namespace sprekk {

/// A linear function of fields that a component offers where it has no field of that quantity: for example the pressure
/// at the walls as a function of the pressures of the cells and the flux through the walls. All matrices have
/// constant.size() rows. With several processes, only the rows of entities that the process owns are right. Code that
/// needs all values, and not only those that become rows of an assembly, calls `exchange`.
struct LinearExpression {
  /// matrix · field.
  struct Term {
    const Field* field;
    Operator matrix;
  };
  Vector constant;
  std::vector<Term> terms;

  Vector now() const;
  Vector accepted() const;  ///< with the accepted values of the fields and the present constant
};

}  // namespace sprekk
