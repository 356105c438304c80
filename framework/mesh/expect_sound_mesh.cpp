#include "framework/mesh/expect_sound_mesh.hpp"

#include "framework/invariants.hpp"
#include "framework/mesh/geometry.hpp"

namespace sprekk {

#ifdef SPREKK_ASSERTIONS

namespace {

void expect_sound_lists(const Mesh& mesh) {
  const auto nodes = static_cast<std::size_t>(mesh.node_count()), cells = static_cast<std::size_t>(mesh.cell_count());
  const auto faces = static_cast<std::size_t>(mesh.face_count());
  SPREKK_ASSERT(mesh.cell_faces.size() == cells, mesh.cell_faces.size(), cells);
  SPREKK_ASSERT(mesh.cell_center.size() == cells, mesh.cell_center.size(), cells);
  SPREKK_ASSERT(mesh.cell_measure.size() == cells, mesh.cell_measure.size(), cells);
  SPREKK_ASSERT(mesh.cell_region.size() == cells, mesh.cell_region.size(), cells);
  SPREKK_ASSERT(mesh.face_cells.size() == faces, mesh.face_cells.size(), faces);
  SPREKK_ASSERT(mesh.face_center.size() == faces, mesh.face_center.size(), faces);
  SPREKK_ASSERT(mesh.face_measure.size() == faces, mesh.face_measure.size(), faces);
  SPREKK_ASSERT(mesh.face_normal.size() == faces, mesh.face_normal.size(), faces);
  SPREKK_ASSERT(mesh.face_side.size() == faces, mesh.face_side.size(), faces);
  SPREKK_ASSERT(mesh.face_fracture_cell.size() == faces, mesh.face_fracture_cell.size(), faces);
  SPREKK_ASSERT(static_cast<std::size_t>(mesh.node_cells.size()) == nodes, mesh.node_cells.size(), nodes);
  SPREKK_ASSERT(static_cast<std::size_t>(mesh.node_faces.size()) == nodes, mesh.node_faces.size(), nodes);
  SPREKK_ASSERT(are_indices(mesh.cell_region, static_cast<long>(mesh.region_names.size())), mesh.region_names.size());
}

void expect_sound_cell(const Mesh& mesh, int cell) {
  const CellNodes& nodes = mesh.cell_nodes[cell];
  const CellFaces& faces = mesh.cell_faces[cell];
  SPREKK_ASSERT(faces.size() == faces_to_number(nodes).size(), cell, nodes.size(), faces.size());
  SPREKK_ASSERT(are_indices(nodes, mesh.node_count()), cell);
  SPREKK_ASSERT(are_indices(faces, mesh.face_count()), cell);
  SPREKK_ASSERT(mesh.cell_measure[cell] > 0, cell, mesh.cell_measure[cell]);
  SPREKK_ASSERT(mesh.cell_center[cell].allFinite(), cell);
  for (int k = 0; k < faces.size(); ++k) {
    const FaceNodes wanted = nodes_of_face(nodes, k), &face = mesh.face_nodes[faces[k]];
    const bool is_first = mesh.face_cells[faces[k]][0] == cell;
    SPREKK_ASSERT(is_first || mesh.face_cells[faces[k]][1] == cell, cell, faces[k]);
    SPREKK_ASSERT(is_first ? face == wanted : have_same_nodes(face, wanted) && turn_alike(face, reversed(wanted)), cell,
                  faces[k], face[0], face[1], wanted[0], wanted[1]);
  }
}

void expect_sound_face(const Mesh& mesh, int face) {
  const auto& [first, second] = mesh.face_cells[face];
  SPREKK_ASSERT(are_indices(mesh.face_nodes[face], mesh.node_count()), face);
  SPREKK_ASSERT(is_index(first, mesh.cell_count()), face, first);
  SPREKK_ASSERT(second == none || is_index(second, mesh.cell_count()), face, second);
  SPREKK_ASSERT(first != second, face, first);
  SPREKK_ASSERT(mesh.face_measure[face] > 0, face, mesh.face_measure[face]);
  SPREKK_ASSERT(std::abs(mesh.face_normal[face].norm() - 1) < nearly_equal, face, mesh.face_normal[face].norm());
  const double outwards = mesh.face_normal[face].dot(mesh.face_center[face] - mesh.cell_center[first]);
  SPREKK_ASSERT(outwards > 0, face, first, outwards);
  // Inside, on the outer boundary, or a wall: one of three.
  const bool is_outer = mesh.face_side[face] != none, is_wall = mesh.face_fracture_cell[face] != none;
  SPREKK_ASSERT((second != none) + is_outer + is_wall == 1, face, second, mesh.face_side[face],
                mesh.face_fracture_cell[face]);
  SPREKK_ASSERT(!is_outer || is_index(mesh.face_side[face], static_cast<long>(mesh.side_names.size())), face);
  SPREKK_ASSERT(!is_wall || is_index(mesh.face_fracture_cell[face], mesh.fracture_cell_count()), face);
}

void expect_sound_fracture_cell(const Mesh& mesh, int i) {
  const FractureCell& cell = mesh.fracture_cells[i];
  SPREKK_ASSERT(is_index(cell.fracture, static_cast<long>(mesh.fractures.size())), i, cell.fracture);
  SPREKK_ASSERT(are_indices(cell.ridges, static_cast<long>(mesh.ridges.size())), i);
  SPREKK_ASSERT(are_indices(cell.faces, mesh.face_count()), i);
  SPREKK_ASSERT(cell.measure > 0, i, cell.measure);
  SPREKK_ASSERT(std::abs(cell.normal.norm() - 1) < nearly_equal, i, cell.normal.norm());
  SPREKK_ASSERT((cell.tangents - tangents_of(cell.normal)).norm() < nearly_equal, i);
  for (const int face : cell.faces) {
    SPREKK_ASSERT(mesh.face_fracture_cell[face] == i, i, face, mesh.face_fracture_cell[face]);
    SPREKK_ASSERT(std::abs(mesh.face_measure[face] - cell.measure) <= nearly_equal * cell.measure, i, face,
                  cell.measure);
    SPREKK_ASSERT((mesh.face_center[face] - cell.center).norm() <= nearly_equal * (cell.measure + cell.center.norm()),
                  i, face);
  }
  // The normal points from the plus to the minus side: out of the cell on the plus side.
  SPREKK_ASSERT(mesh.face_normal[cell.faces[0]].dot(cell.normal) > 0, i);
  SPREKK_ASSERT(mesh.face_normal[cell.faces[1]].dot(cell.normal) < 0, i);
}

void expect_sound_ridge(const Mesh& mesh, int p) {
  using Kind = Ridge::Kind;
  const Ridge& ridge = mesh.ridges[p];
  SPREKK_ASSERT(ridge.measure > 0, p, ridge.measure);
  SPREKK_ASSERT(are_indices(ridge.cells, mesh.fracture_cell_count()), p);
  SPREKK_ASSERT(is_ascending(ridge.cells), p);
  const bool is_end = ridge.kind == Kind::tip || ridge.kind == Kind::on_boundary;
  SPREKK_ASSERT(ridge.cells.size() == (is_end ? 1U : 2U), p, ridge.cells.size());
  SPREKK_ASSERT((ridge.side != none) == (ridge.kind == Kind::on_boundary), p, ridge.side);
}

}  // namespace

void expect_sound(const Mesh& mesh) {
  expect_sound_lists(mesh);
  for (int cell = 0; cell < mesh.cell_count(); ++cell) expect_sound_cell(mesh, cell);
  for (int face = 0; face < mesh.face_count(); ++face) expect_sound_face(mesh, face);
  for (int node = 0; node < mesh.node_count(); ++node) {
    SPREKK_ASSERT(mesh.nodes[node].allFinite(), node);
    SPREKK_ASSERT(are_indices(mesh.node_cells[node], mesh.cell_count()), node);
    SPREKK_ASSERT(are_indices(mesh.node_faces[node], mesh.face_count()), node);
    SPREKK_ASSERT(is_ascending(mesh.node_cells[node]) && is_ascending(mesh.node_faces[node]), node);
  }
  int next = 0;
  for (const Fracture& fracture : mesh.fractures) {
    SPREKK_ASSERT(fracture.cell_count > 0, fracture.name, fracture.cell_count);
    SPREKK_ASSERT(fracture.first_cell == next, fracture.name, fracture.first_cell, next);
    next += fracture.cell_count;
  }
  SPREKK_ASSERT(next == mesh.fracture_cell_count(), next, mesh.fracture_cell_count());
  for (int i = 0; i < mesh.fracture_cell_count(); ++i) expect_sound_fracture_cell(mesh, i);
  for (int p = 0; p < static_cast<int>(mesh.ridges.size()); ++p) expect_sound_ridge(mesh, p);
  for (const Junction& junction : mesh.junctions) {
    SPREKK_ASSERT(junction.cells.size() >= 2, junction.cells.size());
    SPREKK_ASSERT(are_indices(junction.cells, mesh.fracture_cell_count()));
    SPREKK_ASSERT(are_indices(junction.ridges, static_cast<long>(mesh.ridges.size())));
  }
}

#else

void expect_sound(const Mesh&) {}

#endif

}  // namespace sprekk
