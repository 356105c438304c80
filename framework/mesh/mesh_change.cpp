#include "framework/mesh/mesh_change.hpp"

#include <numeric>

#include "framework/invariants.hpp"

namespace sprekk {

namespace {

std::vector<int> itself(std::size_t count) {
  std::vector<int> origin(count);
  std::iota(origin.begin(), origin.end(), 0);
  return origin;
}

}  // namespace

Vector covered_parts(const MeshChange& change, const Mesh& after) {
  Vector parts = Vector::Ones(after.fracture_cell_count());
  for (int i = 0; i < after.fracture_cell_count(); ++i)
    if (change.fracture_cell[i] == none) parts[i] = 0;
  for (const ReplacedPart& part : change.replaced_parts)
    parts[part.cell] += part.length / after.fracture_cells[part.cell].measure;
  return parts;
}

Vector shared_in_cells(const MeshChange& change, const Mesh& before, const Vector& amounts, int components) {
  SPREKK_EXPECT(amounts.size() == components * before.cell_count(), amounts.size(), components, before.cell_count());
  const auto of = [components](auto& values, Eigen::Index cell) {
    return values.segment(cell * components, components);
  };
  Vector shared = Vector::Zero(static_cast<Eigen::Index>(change.cell.size()) * components);
  for (std::size_t cell = 0; cell < change.cell.size(); ++cell)
    if (change.cell[cell] != none) of(shared, static_cast<Eigen::Index>(cell)) = of(amounts, change.cell[cell]);
  for (int k = 0; k < change.overlap.outerSize(); ++k)
    for (SparseMatrix::InnerIterator entry(change.overlap, k); entry; ++entry)
      if (change.cell[entry.row()] == none)
        of(shared, entry.row()) += entry.value() / before.cell_measure[entry.col()] * of(amounts, entry.col());
  return shared;
}

Vector shared_in_fracture_cells(const MeshChange& change, const Vector& amounts) {
  Vector shared = Vector::Zero(static_cast<Eigen::Index>(change.fracture_cell.size()));
  for (std::size_t cell = 0; cell < change.fracture_cell.size(); ++cell)
    if (change.fracture_cell[cell] != none)
      shared[static_cast<Eigen::Index>(cell)] = amounts[change.fracture_cell[cell]];
  for (const ReplacedPart& part : change.replaced_parts) shared[part.cell] += part.share * amounts[part.old_cell];
  return shared;
}

MeshChange no_change(const Mesh& mesh) {
  MeshChange change;
  change.cell = itself(mesh.cell_count());
  change.face = itself(mesh.face_count());
  change.fracture_cell = itself(mesh.fracture_cell_count());
  change.ridge = itself(mesh.ridges.size());
  return change;
}

}  // namespace sprekk
