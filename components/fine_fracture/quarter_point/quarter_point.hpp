// Tips whose fine levels are meshes of quadratic triangles with quarter-point elements.
#pragma once

#include <optional>
#include <string>

#include "components/fine_fracture/tips/tips.hpp"

namespace sprekk::fine_fracture {

/// Parameters of such tips.
struct QuarterPointOptions : TipsOptions {
  double mesh_ratio = 0.5;  ///< epsilon_m of sec. 4.1 of the paper
  int sectors = 16;
  std::optional<double> tolerance;  ///< of the error estimate; without it, meshes have the given sizes
  std::string factors = "interaction_integral";
  Spec spec();
};

/// The component of such tips.
class QuarterPoint : public Tips {
 public:
  QuarterPoint(const ComponentContext& context, const QuarterPointOptions& options);
};

}  // namespace sprekk::fine_fracture
