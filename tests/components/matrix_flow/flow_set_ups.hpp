// Conditions, meshes and mobilities that tests of flow discretizations share.
#pragma once

#include <vector>

#include "components/matrix_flow/flux_operators.hpp"
#include "tests/components/layers.hpp"

namespace sprekk::test {

/// Prescribed pressure and prescribed flux in turn; walls have prescribed flux.
inline std::vector<matrix_flow::FlowCondition> mixed_conditions(const Mesh& mesh) {
  using matrix_flow::FlowCondition;
  std::vector<FlowCondition> conditions(mesh.face_count(), FlowCondition::none);
  for (int f = 0; f < mesh.face_count(); ++f)
    if (is_outer(mesh, f))
      conditions[f] = f % 2 == 0 && !is_wall(mesh, f) ? FlowCondition::pressure : FlowCondition::flux;
  return conditions;
}

/// Triangles and quadrilaterals, with fractures, corners of a single cell and narrow gaps.
inline std::vector<Mesh> various_meshes() {
  return {
      fractured_square(),        square_with_single_corners(6),     fractured_rectangles(),
      square_with_narrow_gaps(), fractured_square(mixed(0.1, 0.3)), generate_mesh(box(2, 1), structured(7, 5, 0.4))};
}

/// `contrast` in the lower one of two_layers, and 1 in the upper one.
inline std::vector<Tensor> mobility_of_layers(const Mesh& mesh, double contrast) {
  std::vector<Tensor> mobility(mesh.cell_count(), Tensor::Identity());
  for (int c = 0; c < mesh.cell_count(); ++c)
    if (is_lower(mesh.cell_center[c])) mobility[c] *= contrast;
  return mobility;
}

}  // namespace sprekk::test
