// Principal values and axes of a tensor.
#pragma once

#include "framework/types.hpp"

namespace sprekk {

/// Principal values, and the axes along which they hold.
struct PrincipalAxes {
  Point values;  ///< in ascending order
  Tensor axes;   ///< a column each, of length 1
};

/// Of a symmetric tensor, of which only the lower triangle is read.
PrincipalAxes principal_axes(const Tensor& tensor);

}  // namespace sprekk
