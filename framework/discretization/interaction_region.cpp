#include "framework/discretization/interaction_region.hpp"

#include <algorithm>

#include "framework/discretization/dual_vectors.hpp"
#include "framework/discretization/subface.hpp"
#include "framework/invariants.hpp"
#include "framework/mesh/quality/cell_angles.hpp"
#include "framework/mesh/quality/mesh_quality.hpp"

namespace sprekk {

namespace {

int index_in(std::span<const int> items, int item) {
  return static_cast<int>(std::find(items.begin(), items.end(), item) - items.begin());
}

bool touches(const FaceNodes& face, int node) {
  if constexpr (dimension == 2) {
    return face[0] == node || face[1] == node;
  } else {
    return std::find(face.begin(), face.end(), node) != face.end();
  }
}

/// From the centre of an inner face.
Point way_to_continuity_point(const Mesh& mesh, int face, int node) {
  if constexpr (dimension == 2) {
    return (mesh.nodes[node] - mesh.face_center[face]) / 3;
  } else {
    const auto& [way, part] = continuity_point(mesh, face, node);
    return part * way;
  }
}

}  // namespace

void InteractionRegion::assign(const Mesh& mesh, int node) {
  const auto node_cells = mesh.node_cells[node];
  const auto node_faces = mesh.node_faces[node];
  SPREKK_EXPECT(is_index(node, mesh.node_count()), node, mesh.node_count());
  faces.assign(node_faces.begin(), node_faces.end());
  shares.resize(faces.size());
  for (int f = 0; f < subface_count(); ++f) shares[f] = share_at_node(mesh, faces[f], node);
  neighbours.assign(faces.size(), {none, none});
  subcells.resize(node_cells.size());
  for (int k = 0; k < subcell_count(); ++k) {
    Subcell& subcell = subcells[k];
    subcell.cell = node_cells[k];
    const Point& center = mesh.cell_center[subcell.cell];
    std::array<Point, dimension> arm, face_center;
    int found = 0;
    for (const int face : mesh.cell_faces[subcell.cell]) {
      if (!touches(mesh.face_nodes[face], node)) continue;
      const bool is_inner = mesh.face_cells[face][1] != none;
      const int side = mesh.face_cells[face][0] == subcell.cell ? 0 : 1;
      const int subface = index_in(node_faces, face);
      SPREKK_ASSERT(found < dimension, node, subcell.cell, found);
      SPREKK_ASSERT(is_index(subface, subface_count()), node, face, subface);
      subcell.subfaces[found] = subface;
      neighbours[subface][side] = k;
      face_center[found] = mesh.face_center[face];
      arm[found] = face_center[found] - center;
      if (is_inner) arm[found] += way_to_continuity_point(mesh, face, node);
      const double share = shares[subface];
      subcell.half_face[found] = (side == 0 ? share : -share) * mesh.face_measure[face] * mesh.face_normal[face];
      ++found;
    }
    SPREKK_ASSERT(found == dimension, node, subcell.cell, found);
    subcell.gradient = dual_vectors<dimension>(arm);
    subcell.measure = subcell_measure(center, mesh.nodes[node], face_center, subcell.half_face);
    SPREKK_ASSERT(subcell.measure > 0, node, subcell.cell, subcell.measure);
  }
}

Adjacency outer_faces_of_nodes(const Mesh& mesh) {
  Adjacency outer;
  outer.offsets.reserve(mesh.node_count() + 1);
  for (int node = 0; node < mesh.node_count(); ++node) {
    for (const int face : mesh.node_faces[node])
      if (mesh.face_cells[face][1] == none) outer.items.push_back(face);
    outer.offsets.push_back(static_cast<int>(outer.items.size()));
  }
  return outer;
}

std::runtime_error unsolvable_region(const std::string& method, const Mesh& mesh, const InteractionRegion& region,
                                     const std::string& coefficient) {
  const auto angle = [&](const Subcell& subcell) { return angles(mesh.nodes, mesh.cell_nodes[subcell.cell]).smallest; };
  const Subcell& flattest = *std::ranges::min_element(region.subcells, {}, angle);
  return std::runtime_error(method + ": the local problem at a node cannot be solved, where the mesh has " +
                            flatness_text(mesh, flattest.cell) + " (cells that flat leave no digits, or the " +
                            coefficient + " is not positive definite) move lines apart, join them, or let them meet " +
                            "at a larger angle");
}

}  // namespace sprekk
