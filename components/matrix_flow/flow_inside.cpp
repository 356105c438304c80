#include "components/matrix_flow/flow_inside.hpp"

#include <algorithm>

#include "framework/discretization/changes_along_face.hpp"
#include "framework/invariants.hpp"
#include "framework/matrix_of.hpp"

namespace sprekk::matrix_flow {

namespace {

/// Faces without a row get one that gives them the pressure of fluid at rest, scaled like the other rows.
void keep_values(SparseMatrix& continuity, const std::vector<char>& keeps) {
  const double largest = Vector(continuity.diagonal()).maxCoeff();
  SparseMatrix rows(continuity.rows(), continuity.cols());
  std::vector<Triplet> entries;
  for (int face = 0; face < continuity.rows(); ++face)
    if (!keeps[face]) entries.emplace_back(face, face, largest);
  rows.setFromTriplets(entries.begin(), entries.end());
  continuity += rows;
}

}  // namespace

FluxOperators discretize_inside(Discretize discretize, const FlowInputs& flow, const Mesh& separated,
                                const std::vector<char>& inside, const std::vector<char>& open,
                                const std::vector<char>& nodes) {
  const Mesh& mesh = flow.mesh;
  SPREKK_EXPECT(separated.face_count() >= mesh.face_count(), separated.face_count(), mesh.face_count());
  std::vector<FlowCondition> conditions = flow.conditions;
  conditions.resize(separated.face_count());
  for (int face = 0; face < separated.face_count(); ++face)
    if (face >= mesh.face_count() || mesh.face_cells[face][1] != none)
      conditions[face] = separated.face_cells[face][1] == none ? FlowCondition::flux : FlowCondition::none;
  std::vector<char> wanted(separated.node_count(), 0);
  for (int node = 0; node < separated.node_count(); ++node)
    wanted[node] = inside[separated.node_cells[node][0]] && (nodes.empty() || nodes[node]);
  // Cells without flow need some mobility, which has no effect on other cells.
  std::vector<Tensor> mobility = flow.mobility;
  for (int cell = 0; cell < mesh.cell_count(); ++cell)
    if (!inside[cell]) mobility[cell] = Tensor::Identity();

  FluxOperators made = discretize(separated, mobility, conditions, wanted);
  // Faces between cells with and without flow are inner faces of the whole mesh: unless they are open, nothing is
  // prescribed there, and no traces are needed.
  std::vector<char> keeps(separated.face_count(), 0);
  for (int face = 0; face < mesh.face_count(); ++face) {
    const bool is_cut = separated.face_cells[face] != mesh.face_cells[face];
    keeps[face] = is_cut ? !open.empty() && open[face] : inside[mesh.face_cells[face][0]];
  }
  /// Columns: some for each face, or one for each cell.
  const auto reduce = [&](SparseMatrix& matrix, int of_face) {
    if (matrix.rows() == 0) return;
    const auto is_kept = [&](int column) {
      return of_face == 0 || (column < of_face * mesh.face_count() && keeps[column / of_face]);
    };
    std::vector<Triplet> entries;
    for (int row = 0; row < mesh.face_count(); ++row)
      if (keeps[row])
        for (SparseMatrix::InnerIterator entry(matrix, row); entry; ++entry)
          if (is_kept(static_cast<int>(entry.col()))) entries.emplace_back(row, entry.col(), entry.value());
    SparseMatrix reduced =
        matrix_of(mesh.face_count(), of_face > 0 ? of_face * mesh.face_count() : mesh.cell_count(), entries);
    matrix.swap(reduced);
  };
  constexpr int of_cells = 0;
  reduce(made.flux_cell, of_cells);
  reduce(made.trace_cell, of_cells);
  for (SparseMatrix* of_faces : {&made.flux_boundary, &made.trace_boundary, &made.blended_nodes}) reduce(*of_faces, 1);
  for (SparseMatrix* change : {&made.flux_change, &made.trace_change}) reduce(*change, directions_of_faces);
  FacePressureOperators& faces = made.faces;
  reduce(faces.continuity_cell, of_cells);
  for (SparseMatrix* of_faces : {&faces.flux, &faces.trace, &faces.continuity_face, &faces.continuity_boundary})
    reduce(*of_faces, 1);
  if (faces.continuity_face.rows() > 0) keep_values(faces.continuity_face, keeps);
  for (OneSidedFluxOperators& one : made.limited) {
    reduce(one.cell, of_cells);
    reduce(one.boundary, 1);
    reduce(one.change, directions_of_faces);
  }
  if (open.empty()) return made;
  // A face of the cut points out of the cell inside, and in the whole mesh out of its first cell.
  for (SparseMatrix* flux : {&made.flux_cell, &made.flux_boundary, &made.flux_change, &faces.flux})
    for (int face = 0; face < flux->rows(); ++face)
      if (open[face] && !inside[mesh.face_cells[face][0]]) flux->row(face) *= -1;
  return made;
}

}  // namespace sprekk::matrix_flow
