// Tips whose fine levels have no mesh but elements on the fractures.
#pragma once

#include "components/fine_fracture/tips/tips.hpp"

namespace sprekk::fine_fracture {

/// Parameters of tips whose fine levels are boundary elements.
struct BoundaryElementOptions : TipsOptions {
  double element_ratio = 1;  ///< size of the elements at a tip over the edges of the coarse level there
  int degree = 12;           ///< degree of the regular field
  /// Distance of the places where the stress offset is taken, over the edges of the coarse level.
  double offset_ratio = 0.5;
  Spec spec();
};

/// The component of tips whose fine levels are boundary elements.
class BoundaryElement : public Tips {
 public:
  BoundaryElement(const ComponentContext& context, const BoundaryElementOptions& options);
};

}  // namespace sprekk::fine_fracture
