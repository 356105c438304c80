#include "components/poromechanics/fem/springs.hpp"

#include <algorithm>
#include <vector>

#include "components/poromechanics/check_conditions.hpp"
#include "components/poromechanics/fem/face_functions.hpp"
#include "framework/invariants.hpp"

namespace sprekk::poromechanics {

Springs springs_of_cells(const Options& options, const RawDisplacement& raw) {
  const Mesh& mesh = raw.mesh;
  Springs springs;
  for (int face = 0; face < mesh.face_count(); ++face) {
    const SideCondition* side = condition_of(options, mesh, face);
    if (!side || !side->has_spring()) continue;
    const int cell = mesh.face_cells[face][0];
    const std::vector<int> of_cell = raw.of_cell(cell);
    const auto size = static_cast<Eigen::Index>(dimension * of_cell.size());
    Eigen::MatrixXd& stiffness = springs.try_emplace(cell, Eigen::MatrixXd::Zero(size, size)).first->second;
    const std::vector<FaceFunction> functions = face_functions(raw, {}, face);
    std::vector<Eigen::Index> place;
    for (const FaceFunction& function : functions) {
      const auto found = std::ranges::find(of_cell, function.coefficient);
      SPREKK_ASSERT(found != of_cell.end(), face, function.coefficient);
      place.push_back(dimension * (found - of_cell.begin()));
    }
    for (const FacePoint& point : face_points(raw, face)) {
      const Tensor resists = point.weight * side->spring_at({point.x, mesh.cell_region[cell], 0}, point.normal);
      for (std::size_t i = 0; i < functions.size(); ++i)
        for (std::size_t j = 0; j < functions.size(); ++j)
          stiffness.block<dimension, dimension>(place[i], place[j]) += point.value[i] * point.value[j] * resists;
    }
  }
  return springs;
}

}  // namespace sprekk::poromechanics
