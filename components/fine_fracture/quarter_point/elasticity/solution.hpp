// Displacements and stress-intensity factors of the fine level.
#pragma once

#include <memory>
#include <vector>

#include "components/fine_fracture/fine_level/fine_rock.hpp"
#include "components/fine_fracture/quarter_point/elasticity/element_locator.hpp"
#include "components/fine_fracture/quarter_point/elasticity/intensities.hpp"

namespace sprekk::fine_fracture {

/// A solution of the fine level.
struct FineSolution {
  std::shared_ptr<const FineMesh> mesh;
  FineRock rock;
  Vector displacement;               ///< (x, y) per node, m
  std::vector<TipIntensities> tips;  ///< in the order of FineMesh::tips, or the wanted tip alone

  /// The displacement (m) at a place that an ElementLocator has found.
  Point displacement_at(const ElementPlace& place) const;
  /// du_i/dx_j.
  Tensor gradient_at(const ElementPlace& place) const;
  /// The stress C eps(u), Pa, without the offset; infinite at a tip.
  Tensor elastic_stress_at(const ElementPlace& place) const;
};

}  // namespace sprekk::fine_fracture
