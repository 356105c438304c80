#include "framework/discretization/kept_regions.hpp"

#include <algorithm>
#include <cstring>
#include <stdexcept>
#include <tuple>
#include <utility>

#include "framework/invariants.hpp"

namespace sprekk {

namespace {

// Not ==, for which zeros of both signs are equal.
bool same_bits(double a, double b) { return std::memcmp(&a, &b, sizeof a) == 0; }
bool same_bits(const Point& a, const Point& b) { return std::memcmp(a.data(), b.data(), sizeof a) == 0; }

std::vector<int> inverse(const std::vector<int>& origin, int count) {
  SPREKK_EXPECT(std::ranges::all_of(origin, [&](int i) { return i == none || is_index(i, count); }), count);
  std::vector<int> inverse(count, none);
  for (int i = 0; i < static_cast<int>(origin.size()); ++i)
    if (origin[i] != none) inverse[origin[i]] = i;
  return inverse;
}

/// Whether both lists agree item by item; `origin` maps items after the change to those before.
template <class After, class Before>
bool maps(const After& after, const Before& before, const std::vector<int>& origin) {
  return std::equal(std::begin(after), std::end(after), std::begin(before), std::end(before),
                    [&](int now, int was) { return origin[now] == was; });
}

class Comparison {
 public:
  Comparison(const RegionInputs& before, const RegionInputs& after, const MeshChange& change,
             const KeptRegions::Compare& same_cell, const KeptRegions::Compare& same_face)
      : before_(before), after_(after), change_(change) {
    find_nodes();
    is_same_face_.resize(after.mesh.face_count());
    for (int face = 0; face < after.mesh.face_count(); ++face) {
      const int was = change.face[face];
      is_same_face_[face] = was != none && has_same_geometry(face, was) && same_face(face, was);
    }
    is_same_cell_.resize(after.mesh.cell_count());
    for (int cell = 0; cell < after.mesh.cell_count(); ++cell) {
      const int was = change.cell[cell];
      is_same_cell_[cell] = was != none && same_bits(after.mesh.cell_center[cell], before.mesh.cell_center[was]) &&
                            same_bits(after.mesh.cell_measure[cell], before.mesh.cell_measure[was]) &&
                            has_same_faces(cell, was) && same_cell(cell, was);
    }
  }

  /// The node before the change that has the same region, or none.
  int kept_node(int node) const {
    const int was = old_node_[node];
    if (was == none || !same_bits(after_.mesh.nodes[node], before_.mesh.nodes[was])) return none;
    const auto cells = after_.node_cells[node];
    const auto faces = after_.mesh.node_faces[node];
    const bool is_kept = maps(cells, before_.node_cells[was], change_.cell) &&
                         maps(after_.mesh.node_cells[node], before_.mesh.node_cells[was], change_.cell) &&
                         maps(faces, before_.mesh.node_faces[was], change_.face) &&
                         std::all_of(cells.begin(), cells.end(), [this](int cell) { return is_same_cell_[cell]; }) &&
                         std::all_of(faces.begin(), faces.end(), [this](int face) { return is_same_face_[face]; });
    return is_kept ? was : none;
  }

 private:
  void find_nodes() {
    old_node_.assign(after_.mesh.node_count(), none);
    for (int cell = 0; cell < after_.mesh.cell_count(); ++cell) {
      if (change_.cell[cell] == none) continue;
      auto was = before_.mesh.cell_nodes[change_.cell[cell]].begin();
      for (const int node : after_.mesh.cell_nodes[cell]) old_node_[node] = *was++;
    }
  }

  /// Whether a cell has the same faces as before, regardless of the cells on their other sides.
  bool has_same_faces(int cell, int was) const {
    const auto faces = after_.mesh.cell_faces[cell], old_faces = before_.mesh.cell_faces[was];
    if (!maps(faces, old_faces, change_.face)) return false;
    for (int k = 0; k < faces.size(); ++k)
      if (!has_same_shape(faces[k], old_faces[k])) return false;
    return true;
  }

  bool has_same_geometry(int face, int was) const {
    for (int k = 0; k < 2; ++k) {
      const int cell = after_.mesh.face_cells[face][k], old_cell = before_.mesh.face_cells[was][k];
      if ((cell == none) != (old_cell == none) || (cell != none && change_.cell[cell] != old_cell)) return false;
    }
    return has_same_shape(face, was);
  }

  bool has_same_shape(int face, int was) const {
    const Mesh &after = after_.mesh, &before = before_.mesh;
    const FaceNodes &nodes = after.face_nodes[face], &old_nodes = before.face_nodes[was];
    if (!std::equal(nodes.begin(), nodes.end(), old_nodes.begin(), old_nodes.end(),
                    [&](int now, int then) { return same_bits(after.nodes[now], before.nodes[then]); }))
      return false;
    const int wall = after.face_fracture_cell[face], old_wall = before.face_fracture_cell[was];
    if ((wall == none) != (old_wall == none) || (wall != none && change_.fracture_cell[wall] != old_wall)) return false;
    return same_bits(after.face_center[face], before.face_center[was]) &&
           same_bits(after.face_measure[face], before.face_measure[was]) &&
           same_bits(after.face_normal[face], before.face_normal[was]);
  }

  const RegionInputs &before_, &after_;
  const MeshChange& change_;
  std::vector<int> old_node_;  ///< by the corners of kept cells; its region differs if it has other cells
  std::vector<char> is_same_face_, is_same_cell_;
};

/// Terms of several nodes at one place of a row are added in the order of the nodes.
template <class Nodes>
bool same_order(const Nodes& nodes, const std::vector<int>& kept_node) {
  for (const int a : nodes)
    for (const int b : nodes)
      if ((a < b) != (kept_node[a] < kept_node[b])) return false;
  return true;
}

template <class Nodes>
std::vector<int> kept_rows(const std::vector<Nodes>& entity_nodes, const std::vector<int>& origin,
                           const std::vector<int>& kept_node, std::vector<char>& nodes_to_compute) {
  std::vector<int> rows(origin);
  for (std::size_t entity = 0; entity < rows.size(); ++entity) {
    const Nodes& nodes = entity_nodes[entity];
    if (rows[entity] != none &&
        std::all_of(nodes.begin(), nodes.end(), [&](int node) { return kept_node[node] != none; }) &&
        same_order(nodes, kept_node))
      continue;
    rows[entity] = none;
    for (const int node : nodes) nodes_to_compute[node] = 1;
  }
  return rows;
}

}  // namespace

KeptRegions::KeptRegions(const RegionInputs& before, const RegionInputs& after, const MeshChange& change,
                         const Compare& same_cell, const Compare& same_face)
    : mesh_(after.mesh),
      new_cell_(inverse(change.cell, before.mesh.cell_count())),
      new_face_(inverse(change.face, before.mesh.face_count())),
      nodes_to_compute_(after.mesh.node_count(), 0) {
  SPREKK_EXPECT(static_cast<int>(change.cell.size()) == after.mesh.cell_count(), change.cell.size());
  SPREKK_EXPECT(static_cast<int>(change.face.size()) == after.mesh.face_count(), change.face.size());
  SPREKK_EXPECT(static_cast<int>(change.fracture_cell.size()) == after.mesh.fracture_cell_count());
  const Comparison comparison(before, after, change, same_cell, same_face);
  std::vector<int> kept_node(mesh_.node_count());
  for (int node = 0; node < mesh_.node_count(); ++node) kept_node[node] = comparison.kept_node(node);
  face_rows_ = kept_rows(mesh_.face_nodes, change.face, kept_node, nodes_to_compute_);
  cell_rows_ = kept_rows(mesh_.cell_nodes, change.cell, kept_node, nodes_to_compute_);
}

int KeptRegions::nodes_computed() const {
  return static_cast<int>(std::count(nodes_to_compute_.begin(), nodes_to_compute_.end(), 1));
}

int KeptRegions::cells_computed() const {
  return static_cast<int>(std::count_if(mesh_.cell_nodes.begin(), mesh_.cell_nodes.end(), [this](const auto& nodes) {
    return std::any_of(nodes.begin(), nodes.end(), [this](int node) { return nodes_to_compute_[node] != 0; });
  }));
}

SparseMatrix KeptRegions::merge(const SparseMatrix& before, const SparseMatrix& after, Entity rows,
                                Entity columns) const {
  const std::vector<int>& origin = kept(rows);
  const std::vector<int>& new_column = columns == Entity::cell ? new_cell_ : new_face_;
  const int entities = static_cast<int>(origin.size());
  SPREKK_EXPECT(entities == 0 || after.rows() % entities == 0, after.rows(), entities);
  SPREKK_EXPECT(before.isCompressed() && after.isCompressed());
  const int column_entities = columns == Entity::cell ? mesh_.cell_count() : mesh_.face_count();
  const int row_components = entities > 0 ? static_cast<int>(after.rows()) / entities : 0;
  const int components = column_entities > 0 ? static_cast<int>(after.cols()) / column_entities : 1;
  SparseMatrix merged(after.rows(), after.cols());
  int* start = merged.outerIndexPtr();
  // `from` and its row, for every row of the result.
  const auto source = [&](int entity, int i) {
    const bool is_kept = origin[entity] != none;
    return std::pair(is_kept ? &before : &after, (is_kept ? origin[entity] : entity) * row_components + i);
  };
  start[0] = 0;
  for (int entity = 0; entity < entities; ++entity)
    for (int i = 0; i < row_components; ++i) {
      const auto [from, row] = source(entity, i);
      start[entity * row_components + i + 1] =
          start[entity * row_components + i] + from->outerIndexPtr()[row + 1] - from->outerIndexPtr()[row];
    }
  merged.resizeNonZeros(start[merged.rows()]);
  std::vector<std::pair<int, double>> unsorted;
  for (int entity = 0; entity < entities; ++entity)
    for (int i = 0; i < row_components; ++i) {
      const auto [from, row] = source(entity, i);
      const int begin = from->outerIndexPtr()[row], end = from->outerIndexPtr()[row + 1];
      int* const column = merged.innerIndexPtr() + start[entity * row_components + i];
      double* const value = merged.valuePtr() + start[entity * row_components + i];
      std::copy(from->valuePtr() + begin, from->valuePtr() + end, value);
      if (from == &after) {
        std::copy(from->innerIndexPtr() + begin, from->innerIndexPtr() + end, column);
        continue;
      }
      for (int k = begin; k < end; ++k) {
        const int old = from->innerIndexPtr()[k], now = new_column[old / components];
        if (now == none) throw std::logic_error("a row that was kept reads what was not");
        column[k - begin] = now * components + old % components;
      }
      const int length = end - begin;
      if (std::is_sorted(column, column + length)) continue;
      unsorted.resize(length);
      for (int k = 0; k < length; ++k) unsorted[k] = {column[k], value[k]};
      std::sort(unsorted.begin(), unsorted.end());
      for (int k = 0; k < length; ++k) std::tie(column[k], value[k]) = unsorted[k];
    }
  SPREKK_ASSERT(is_well_formed(merged), merged.rows(), merged.cols());
  return merged;
}

}  // namespace sprekk
