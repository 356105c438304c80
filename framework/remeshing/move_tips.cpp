#include "framework/remeshing/move_tips.hpp"

#include <algorithm>
#include <limits>

#include "framework/invariants.hpp"
#include "framework/matrix_of.hpp"
#include "framework/mesh/build_mesh.hpp"
#include "framework/mesh/plane/planar.hpp"
#include "framework/remeshing/healed_mesh.hpp"
#include "framework/remeshing/overlap.hpp"
#include "framework/remeshing/replaced_parts.hpp"
#include "framework/remeshing/spread_motion.hpp"
#include "framework/round_off.hpp"

namespace sprekk {
namespace {

/// The smallest angle may fall to this part of what it was.
constexpr double least_angle_part = 0.6;

class Motion {
 public:
  Motion(const GrownMesh& grown, double size)
      : grown_(grown), size_(size), raw_(to_raw_mesh(grown.mesh, &merged_)), is_at_rest_(raw_.nodes.size(), false) {
    lay_to_rest();
  }

  /// Whether the points of an extension can be where they are wanted.
  bool place(int index, const PathExtension& extension, const PathExtension& checked) {
    const std::vector<int> nodes = nodes_of_points(index, extension);
    if (nodes.size() != extension.points.size()) return false;
    for (std::size_t i = 0; i < nodes.size(); ++i) {
      const int node = nodes[i];
      const Point by = checked.points[i] - raw_.nodes[node];
      if (is_bound_[node]) {
        if (by.norm() > rounding::same * size_) return false;
      } else {
        if (checked.points[i] != extension.points[i]) return false;  // onto the boundary or another fracture
        moved_.push_back({node, by});
        targets_.push_back(checked.points[i]);
        is_at_rest_[node] = false;
      }
    }
    return true;
  }

  /// The raw mesh with moved nodes, if its cells are good; and their smallest angle.
  std::optional<RawMesh> moved(double& smallest) const {
    const std::vector<Point> motion = spread_motion(raw_.nodes, edges(), is_at_rest_, moved_);
    RawMesh raw = raw_;
    for (std::size_t node = 0; node < raw.nodes.size(); ++node) raw.nodes[node] += motion[node];
    for (std::size_t i = 0; i < moved_.size(); ++i) raw.nodes[moved_[i].node] = targets_[i];  // to the bit
    smallest = std::numeric_limits<double>::infinity();
    for (const int cell : grown_.change.new_cells) {
      const Ring& corners = raw.cells[cell];
      SPREKK_ASSERT(corners.size() == 3, cell, corners.size());
      smallest =
          std::min(smallest, smallest_angle(raw.nodes[corners[0]], raw.nodes[corners[1]], raw.nodes[corners[2]]));
    }
    if (!(smallest >= least_angle_part * grown_.smallest_angle)) return std::nullopt;
    return raw;
  }

 private:
  /// The nodes of a path at its points. Further ones, where whole segments cross interfaces, stay.
  std::vector<int> nodes_of_points(int index, const PathExtension& extension) const {
    const std::vector<int>& chain = raw_.fractures[extension.fracture].nodes;
    const int first = grown_.mesh.fractures[extension.fracture].first_cell;
    std::vector<int> nodes;
    for (const int cell : grown_.extension_cells[index])
      nodes.push_back(chain[cell - first + (extension.at_end ? 1 : 0)]);
    if (extension.whole_segments && nodes.size() > extension.points.size())
      std::erase_if(nodes, [&](int node) { return is_bound_[node]; });
    return nodes;
  }

  /// Nodes of fractures are at rest unless a path moves them; bound nodes are always at rest.
  void lay_to_rest() {
    const Mesh& mesh = grown_.mesh;
    is_bound_.assign(raw_.nodes.size(), false);
    for (int cell = 0; cell < mesh.cell_count(); ++cell) {
      if (grown_.change.cell[cell] == none) continue;
      for (const int node : raw_.cells[cell]) is_bound_[node] = true;
    }
    for (int face = 0; face < mesh.face_count(); ++face) {
      const auto [one, other] = mesh.face_cells[face];
      const bool is_interface = other != none && mesh.cell_region[one] != mesh.cell_region[other];
      if (mesh.face_side[face] == none && !is_interface) continue;
      for (const int node : mesh.face_nodes[face]) is_bound_[merged_[node]] = true;
    }
    for (const FractureCell& cell : mesh.fracture_cells) {
      const auto [plus, minus] = cell.faces;
      if (mesh.cell_region[mesh.face_cells[plus][0]] == mesh.cell_region[mesh.face_cells[minus][0]]) continue;
      for (const int node : mesh.face_nodes[plus]) is_bound_[merged_[node]] = true;
    }
    std::vector<bool> is_on_fracture(raw_.nodes.size(), false);
    for (const auto& [name, chain] : raw_.fractures) {
      for (const int node : chain) {
        if (is_on_fracture[node]) is_bound_[node] = true;  // a junction
        is_on_fracture[node] = true;
      }
    }
    for (std::size_t node = 0; node < raw_.nodes.size(); ++node)
      is_at_rest_[node] = is_bound_[node] || is_on_fracture[node];
  }

  /// The edges with an end that is not at rest.
  std::vector<std::array<int, 2>> edges() const {
    std::vector<std::array<int, 2>> edges;
    for (const auto& [a, b] : grown_.mesh.face_nodes) {
      const int from = merged_[a], to = merged_[b];
      if (!is_at_rest_[from] || !is_at_rest_[to]) edges.push_back({from, to});
    }
    return edges;
  }

  const GrownMesh& grown_;
  const double size_;
  std::vector<int> merged_;
  const RawMesh raw_;
  std::vector<bool> is_bound_;
  std::vector<bool> is_at_rest_;
  std::vector<MovedNode> moved_;
  std::vector<Point> targets_;  ///< of moved_
};

bool have_same_numbers(const Mesh& one, const Mesh& other) {
  const auto same_cell = [](const FractureCell& a, const FractureCell& b) {
    return a.faces == b.faces && a.ridges == b.ridges && a.fracture == b.fracture;
  };
  return one.cell_nodes == other.cell_nodes && one.cell_faces == other.cell_faces &&
         one.face_nodes == other.face_nodes && one.ridges.size() == other.ridges.size() &&
         std::ranges::equal(one.fracture_cells, other.fracture_cells, same_cell);
}

/// Only new cells have moved, so only the overlap and the replaced parts differ from those of `grown`.
MeshChange change_of(const Mesh& before, const GrownMesh& grown, const Mesh& mesh) {
  MeshChange change = grown.change;
  for (int face = 0; face < mesh.face_count(); ++face)
    for (const int node : mesh.face_nodes[face])
      if (mesh.nodes[node] != grown.mesh.nodes[node]) change.face[face] = none;
  std::vector<Corners> made, removed;
  for (const int cell : change.new_cells) made.push_back(corners_of(mesh.nodes, mesh.cell_nodes[cell]));
  for (const int cell : change.removed_cells) removed.push_back(corners_of(before.nodes, before.cell_nodes[cell]));
  std::vector<Triplet> areas;
  for_each_overlap(made, removed, [&](int i, int j, double area) {
    areas.emplace_back(change.new_cells[i], change.removed_cells[j], area);
  });
  for (int cell = 0; cell < mesh.cell_count(); ++cell)
    if (change.cell[cell] != none) areas.emplace_back(cell, change.cell[cell], mesh.cell_measure[cell]);
  change.overlap = matrix_of(mesh.cell_count(), before.cell_count(), areas);
  return change;
}

}  // namespace

std::optional<GrownMesh> move_tips(const Mesh& before, const GrownMesh& grown,
                                   const std::vector<PathExtension>& extensions, const CavityOptions& options) {
  SPREKK_EXPECT(grown.extension_cells.size() == extensions.size(), grown.extension_cells.size(), extensions.size());
  const HealedMesh healed = heal_ends(before, extensions);
  std::vector<PathExtension> checked = extensions;
  for (PathExtension& extension : checked) extension.replaced = 0;
  checked = check_extensions(healed.mesh, checked, options.size);

  Motion motion(grown, options.size);
  for (std::size_t e = 0; e < extensions.size(); ++e)
    if (!motion.place(static_cast<int>(e), extensions[e], checked[e])) return std::nullopt;
  GrownMesh moved;
  const std::optional<RawMesh> raw = motion.moved(moved.smallest_angle);
  if (!raw) return std::nullopt;
  moved.mesh = build_mesh(*raw);
  SPREKK_ASSERT(have_same_numbers(moved.mesh, grown.mesh));
  moved.mesh.cell_rank = grown.mesh.cell_rank;
  for (int i = 0; i < moved.mesh.fracture_cell_count(); ++i)
    moved.mesh.fracture_cells[i].grown = grown.mesh.fracture_cells[i].grown;
  moved.extension_cells = grown.extension_cells;
  moved.change = change_of(before, grown, moved.mesh);
  moved.change.replaced_parts.clear();
  for (std::size_t e = 0; e < extensions.size(); ++e)
    add_replaced_parts(before, healed.replaced[e], moved.mesh, moved.extension_cells[e], moved.change);
  return moved;
}

}  // namespace sprekk
