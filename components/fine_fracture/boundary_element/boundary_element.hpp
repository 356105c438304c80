// Tips whose fine levels have no mesh but elements on the fractures.
#pragma once

#include "components/fine_fracture/tips/tips.hpp"

namespace sprekk::fine_fracture {

/// Parameters of such tips.
struct BoundaryElementOptions : TipsOptions {
  double element_ratio = 1;   ///< of the elements at a tip, over the coarse level's edge there
  int degree = 12;            ///< of the regular field
  double offset_ratio = 0.5;  ///< of the places where the stress offset is taken, over the coarse level's edge
  Spec spec();
};

/// The component of such tips.
class BoundaryElement : public Tips {
 public:
  BoundaryElement(const ComponentContext& context, const BoundaryElementOptions& options);
};

}  // namespace sprekk::fine_fracture
