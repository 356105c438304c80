#include "framework/scene/plane/transfer_in_cells.hpp"

#include <vector>

#include "framework/field/weights_in_cell.hpp"
#include "framework/invariants.hpp"
#include "framework/mesh/corner_weights.hpp"

namespace sprekk {

Vector transferred_in_cells(const Field& old, const MeshChange& change, const Mesh& old_mesh, const Mesh& new_mesh) {
  const Location location = old.spec().location;
  const int components = old.spec().components;
  SPREKK_EXPECT(location == Location::node || location == Location::face, old.name());
  SPREKK_EXPECT(static_cast<int>(change.cell.size()) == new_mesh.cell_count(), change.cell.size());
  const bool on_nodes = location == Location::node;
  const int count = entity_count(new_mesh, location);
  std::vector<int> origin(count, none);
  std::vector<std::vector<int>> old_cells(count);  // below new cells at the entity
  for (int cell = 0; cell < new_mesh.cell_count(); ++cell) {
    const Ring& entities = on_nodes ? new_mesh.cell_nodes[cell] : new_mesh.cell_faces[cell];
    const int from = change.cell[cell];
    for (int k = 0; k < entities.size(); ++k)
      if (from != none)
        origin[entities[k]] = on_nodes ? old_mesh.cell_nodes[from][k] : old_mesh.cell_faces[from][k];
      else
        for (SparseMatrix::InnerIterator entry(change.overlap, cell); entry; ++entry)
          old_cells[entities[k]].push_back(static_cast<int>(entry.col()));
  }
  Vector values = Vector::Zero(static_cast<Eigen::Index>(count) * components);
  for (int i = 0; i < count; ++i) {
    auto value = values.segment(i * components, components);
    if (origin[i] != none) {
      value = old.accepted().segment(origin[i] * components, components);
      continue;
    }
    const Point& x = on_nodes ? new_mesh.nodes[i] : new_mesh.face_center[i];
    const int below = cell_holding(old_mesh, old_cells[i], x);
    for (const auto& [entity, weight] : weights_in_cell(old_mesh, location, below, x))
      value += weight * old.accepted().segment(entity * components, components);
  }
  return values;
}

}  // namespace sprekk
