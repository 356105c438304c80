// What holds for every mesh with extended fractures.
#pragma once

#include <algorithm>
#include <map>
#include <vector>

#include "framework/remeshing/extend_fractures.hpp"
#include "tests/framework/mesh/mesh_checks.hpp"

namespace sprekk::test {

inline Point tip(const Mesh& mesh, int fracture, bool at_end) {
  const auto& [name, first, count] = mesh.fractures[fracture];
  const FractureCell& cell = mesh.fracture_cells[at_end ? first + count - 1 : first];
  return mesh.ridges[cell.ridges[at_end ? 1 : 0]].center;
}

/// Out of the end, of unit length.
inline Point direction(const Mesh& mesh, int fracture, bool at_end) {
  const auto& [name, first, count] = mesh.fractures[fracture];
  return at_end ? mesh.fracture_cells[first + count - 1].tangents : Point(-mesh.fracture_cells[first].tangents);
}

inline Point turned(const Point& x, double angle) {
  return {std::cos(angle) * x.x() - std::sin(angle) * x.y(), std::sin(angle) * x.x() + std::cos(angle) * x.y()};
}

/// One segment from the end of a fracture, turned from its direction.
inline PathExtension straight(const Mesh& mesh, int fracture, bool at_end, double length, double angle = 0) {
  return {fracture, at_end, {tip(mesh, fracture, at_end) + length * turned(direction(mesh, fracture, at_end), angle)}};
}

/// Everything that mesh_change.hpp promises, and that build_mesh promises of the new mesh.
inline void expect_sound(const Mesh& old, const GrownMesh& grown) {
  const auto& [mesh, change, smallest, extension_cells] = grown;
  expect_consistent(mesh);
  ASSERT_NE(mesh.version, old.version);
  ASSERT_EQ(mesh.side_names, old.side_names);
  ASSERT_EQ(mesh.region_names, old.region_names);
  ASSERT_NEAR(total_area(mesh), total_area(old), 1e-12 * total_area(old));

  // Cells.
  ASSERT_EQ(change.cell.size(), mesh.cell_nodes.size());
  std::vector<int> kept(old.cell_count(), 0), made, removed;
  double angle = 10;
  for (int c = 0; c < mesh.cell_count(); ++c) {
    const int from = change.cell[c];
    if (from == none) {
      made.push_back(c);
      const int p = mesh.cell_nodes[c][0], q = mesh.cell_nodes[c][1], r = mesh.cell_nodes[c][2];
      for (const auto& [a, b, d] : {std::array{p, q, r}, std::array{q, r, p}, std::array{r, p, q}}) {
        const Point u = (mesh.nodes[b] - mesh.nodes[a]).normalized(), v = (mesh.nodes[d] - mesh.nodes[a]).normalized();
        angle = std::min(angle, std::acos(u.dot(v)));
      }
      continue;
    }
    ++kept[from];
    // Only cells beyond the end of a shorter list are renumbered.
    if (from != c) {
      ASSERT_GE(from, mesh.cell_count());
    }
    ASSERT_EQ(mesh.cell_region[c], old.cell_region[from]);
    ASSERT_EQ(mesh.cell_rank[c], old.cell_rank[from]);
    ASSERT_EQ(mesh.cell_nodes[c].size(), old.cell_nodes[from].size());
    for (int k = 0; k < mesh.cell_nodes[c].size(); ++k)
      ASSERT_EQ(mesh.nodes[mesh.cell_nodes[c][k]], old.nodes[old.cell_nodes[from][k]]);
    for (int k = 0; k < mesh.cell_faces[c].size(); ++k)
      ASSERT_EQ(change.face[mesh.cell_faces[c][k]], old.cell_faces[from][k]);
  }
  for (int c = 0; c < old.cell_count(); ++c) {
    ASSERT_LE(kept[c], 1);
    if (kept[c] == 0) removed.push_back(c);
  }
  ASSERT_EQ(change.new_cells, made);
  ASSERT_EQ(change.removed_cells, removed);
  ASSERT_NEAR(smallest, angle, 1e-6);
  for (int i = 0; i < mesh.fracture_cell_count(); ++i) {
    const int from = change.fracture_cell[i];
    ASSERT_EQ(mesh.fracture_cells[i].grown, from == none || old.fracture_cells[from].grown) << i;
  }

  // Overlap.
  ASSERT_EQ(change.overlap.rows(), mesh.cell_count());
  ASSERT_EQ(change.overlap.cols(), old.cell_count());
  Vector of_old = Vector::Zero(old.cell_count()), of_new = Vector::Zero(mesh.cell_count());
  for (int c = 0; c < mesh.cell_count(); ++c) {
    for (SparseMatrix::InnerIterator entry(change.overlap, c); entry; ++entry) {
      ASSERT_GT(entry.value(), 0);
      of_new[c] += entry.value();
      of_old[entry.col()] += entry.value();
      ASSERT_EQ(change.cell[c] == none, kept[entry.col()] == 0);
    }
    ASSERT_NEAR(of_new[c], mesh.cell_measure[c], 1e-12 * mesh.cell_measure[c]);
  }
  for (int c = 0; c < old.cell_count(); ++c) ASSERT_NEAR(of_old[c], old.cell_measure[c], 1e-12 * old.cell_measure[c]);

  // Faces.
  ASSERT_EQ(change.face.size(), mesh.face_nodes.size());
  for (int f = 0; f < mesh.face_count(); ++f) {
    const int from = change.face[f];
    if (from == none) continue;
    ASSERT_EQ(mesh.face_center[f], old.face_center[from]);
    ASSERT_EQ(mesh.face_measure[f], old.face_measure[from]);
    ASSERT_EQ(mesh.face_side[f], old.face_side[from]);
    const int cell = mesh.face_fracture_cell[f];
    ASSERT_EQ(cell == none ? none : change.fracture_cell[cell], old.face_fracture_cell[from]);
    if (cell == none) continue;
    ASSERT_EQ(mesh.fracture_cells[cell].faces[0] == f, old.fracture_cells[change.fracture_cell[cell]].faces[0] == from);
  }
  for (const int c : made) {
    for (const int f : mesh.cell_faces[c]) {
      const int cell = mesh.face_fracture_cell[f];
      if (cell == none) continue;
      ASSERT_EQ(change.face[f] == none, change.fracture_cell[cell] == none);
    }
  }

  // Fractures: all old cells are there, in their order, but for those replaced at the ends, and the new ones lie there.
  std::map<int, double> shares;  // by replaced cell
  for (const ReplacedPart& part : change.replaced_parts) {
    ASSERT_GT(part.share, 0);
    ASSERT_EQ(change.fracture_cell[part.cell], none);
    ASSERT_EQ(mesh.fracture_cells[part.cell].fracture, old.fracture_cells[part.old_cell].fracture);
    shares[part.old_cell] += part.share;
  }
  for (const auto& [cell, share] : shares) ASSERT_NEAR(share, 1, 1e-14);
  const int replaced_count = static_cast<int>(shares.size());
  ASSERT_EQ(mesh.fractures.size(), old.fractures.size());
  ASSERT_EQ(change.fracture_cell.size(), mesh.fracture_cells.size());
  ASSERT_EQ(change.ridge.size(), mesh.ridges.size());
  int joined_tips = 0;
  for (std::size_t f = 0; f < mesh.fractures.size(); ++f) {
    ASSERT_EQ(mesh.fractures[f].name, old.fractures[f].name);
    std::vector<int> from;
    for (int i = mesh.fractures[f].first_cell; i < mesh.fractures[f].first_cell + mesh.fractures[f].cell_count; ++i) {
      const int was = change.fracture_cell[i];
      if (was == none) continue;
      from.push_back(was);
      ASSERT_EQ(mesh.fracture_cells[i].center, old.fracture_cells[was].center);
      ASSERT_EQ(mesh.fracture_cells[i].measure, old.fracture_cells[was].measure);
      ASSERT_EQ(mesh.fracture_cells[i].normal, old.fracture_cells[was].normal);
      for (const int end : {0, 1}) {
        const int point = mesh.fracture_cells[i].ridges[end], old_point = old.fracture_cells[was].ridges[end];
        // The tip of a fracture that another one has joined is gone.
        const bool is_joined =
            mesh.ridges[point].kind == Ridge::Kind::junction && old.ridges[old_point].kind == Ridge::Kind::tip;
        ASSERT_EQ(change.ridge[point], is_joined ? none : old_point);
        joined_tips += is_joined ? 1 : 0;
      }
    }
    std::vector<int> expected;
    for (int i = 0; i < old.fractures[f].cell_count; ++i)
      if (!shares.contains(old.fractures[f].first_cell + i)) expected.push_back(old.fractures[f].first_cell + i);
    ASSERT_EQ(from, expected);
  }
  int with_old_place = 0;
  for (std::size_t p = 0; p < mesh.ridges.size(); ++p) {
    if (change.ridge[p] == none) continue;
    ++with_old_place;
    ASSERT_EQ(mesh.ridges[p].center, old.ridges[change.ridge[p]].center);
  }
  ASSERT_EQ(with_old_place + joined_tips + replaced_count, static_cast<int>(old.ridges.size()));
  int grown_cells = 0;
  for (const auto& cells : extension_cells) {
    for (const int cell : cells) ASSERT_EQ(change.fracture_cell[cell], none);
    grown_cells += static_cast<int>(cells.size());
  }
  ASSERT_EQ(grown_cells, mesh.fracture_cell_count() - old.fracture_cell_count() + replaced_count);

  // Interfaces between regions are where they were.
  std::map<std::pair<int, int>, double> interface_length;
  for (const auto& [which, sign] : {std::pair(&mesh, 1), std::pair(&old, -1)}) {
    for (int f = 0; f < which->face_count(); ++f) {
      const auto [one, other] = which->face_cells[f];
      if (other == none || which->cell_region[one] == which->cell_region[other]) continue;
      interface_length[std::minmax(which->cell_region[one], which->cell_region[other])] +=
          sign * which->face_measure[f];
    }
  }
  Vector area = Vector::Zero(static_cast<int>(mesh.region_names.size()));
  for (int c = 0; c < mesh.cell_count(); ++c) area[mesh.cell_region[c]] += mesh.cell_measure[c];
  for (int c = 0; c < old.cell_count(); ++c) area[old.cell_region[c]] -= old.cell_measure[c];
  ASSERT_LT(area.cwiseAbs().maxCoeff(), 1e-10 * total_area(mesh));

  // Cells with all faces but one on walls or outer faces are no more than before.
  const auto single = [](const Mesh& m) {
    int count = 0;
    for (int c = 0; c < m.cell_count(); ++c) {
      int outer = 0;
      for (const int f : m.cell_faces[c]) outer += m.face_cells[f][1] == none ? 1 : 0;
      count += outer + 1 >= m.cell_faces[c].size() ? 1 : 0;
    }
    return count;
  };
  ASSERT_LE(single(mesh), single(old));
}

/// extend_fractures, with all that must hold of its result.
inline GrownMesh extended(const Mesh& mesh, const std::vector<PathExtension>& extensions,
                          const CavityOptions& options) {
  GrownMesh grown = extend_fractures(mesh, extensions, options);
  expect_sound(mesh, grown);
  return grown;
}

/// The fracture point before the last `replaced` cells at an end.
inline Point anchor(const Mesh& mesh, int fracture, bool at_end, int replaced) {
  const auto& [name, first, count] = mesh.fractures[fracture];
  const FractureCell& cell = mesh.fracture_cells[at_end ? first + count - 1 - replaced : first + replaced];
  return mesh.ridges[cell.ridges[at_end ? 1 : 0]].center;
}

/// Replaces the last cells by one in the direction of the old end as seen from the anchor: longer by `more` (m) and
/// turned.
inline PathExtension replacing(const Mesh& mesh, int fracture, bool at_end, int replaced, double more,
                               double angle = 0) {
  const Point from = anchor(mesh, fracture, at_end, replaced), to = tip(mesh, fracture, at_end);
  const Point along = replaced > 0 ? Point((to - from).normalized()) : direction(mesh, fracture, at_end);
  double length = more;
  const auto& [name, first, count] = mesh.fractures[fracture];
  for (int n = 0; n < replaced; ++n) length += mesh.fracture_cells[at_end ? first + count - 1 - n : first + n].measure;
  return {.fracture = fracture,
          .at_end = at_end,
          .points = {from + length * turned(along, angle)},
          .replaced = replaced,
          .whole_segments = true};
}

}  // namespace sprekk::test
