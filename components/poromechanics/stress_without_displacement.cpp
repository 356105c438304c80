#include "components/poromechanics/stress_without_displacement.hpp"

namespace sprekk::poromechanics {

Vector stress_without_displacement(const Mesh& mesh, const Options& options, const Vector& pore_stress) {
  Vector stress = Vector::Zero(symmetric_components * mesh.cell_count());
  for (int c = 0; c < mesh.cell_count(); ++c) {
    auto of_cell = stress.segment<symmetric_components>(symmetric_components * c);
    if (!options.initial_stress.is_zero())
      of_cell = options.initial_stress_at({mesh.cell_center[c], mesh.cell_region[c], 0});
    of_cell.head<dimension>().array() += pore_stress[c];
  }
  return stress;
}

}  // namespace sprekk::poromechanics
