#include "framework/remeshing/extend_fractures.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>
#include <stdexcept>

#include "framework/invariants.hpp"
#include "framework/matrix_of.hpp"
#include "framework/mesh/build_mesh.hpp"
#include "framework/mesh/plane/planar.hpp"
#include "framework/remeshing/healed_mesh.hpp"
#include "framework/remeshing/overlap.hpp"
#include "framework/remeshing/path_nodes.hpp"
#include "framework/remeshing/refill_cavity.hpp"
#include "framework/remeshing/replaced_parts.hpp"
#include "framework/remeshing/same_ridges.hpp"
#include "framework/remeshing/sorted_ends.hpp"

namespace sprekk {
namespace {

class Growth {
 public:
  Growth(const Mesh& mesh, const std::vector<PathExtension>& extensions, const std::vector<std::vector<Segment>>& scars,
         const CavityOptions& options)
      : mesh_(mesh),
        options_(options),
        scars_(scars),
        extensions_(check_extensions(mesh, extensions, options.size)),
        raw_(to_raw_mesh(mesh, &merged_)),
        path_nodes_(place_path_nodes(mesh, raw_, merged_, extensions_, options.size, options.gap_edges)) {
    for (const auto& path : path_nodes_.paths) {
      paths_.emplace_back();
      for (std::size_t i = 0; i + 1 < path.size(); ++i) {
        paths_.back().push_back({path_nodes_.nodes[path[i]], path_nodes_.nodes[path[i + 1]]});
      }
    }
  }

  GrownMesh run() {
    const Refill refill = refill_cavities(mesh_, raw_, merged_, path_nodes_, paths_, scars_, options_);
    SPREKK_ASSERT(static_cast<int>(refill.is_removed.size()) == mesh_.cell_count(), refill.is_removed.size());
    SPREKK_ASSERT(refill.smallest_angle > 0, refill.smallest_angle);
    GrownMesh grown;
    grown.smallest_angle = refill.smallest_angle;
    const RawMesh raw = assemble(refill, grown.change);
    grown.mesh = build_mesh(raw);
    map_cells(grown);
    map_fractures(grown);
    map_faces(raw, grown);
    return grown;
  }

 private:
  RawMesh assemble(const Refill& refill, MeshChange& change) {
    RawMesh raw;
    raw.nodes = refill.nodes;
    raw.region_names = raw_.region_names;
    raw.side_names = raw_.side_names;
    const int old_count = mesh_.cell_count(), made = static_cast<int>(refill.triangles.size());
    for (int cell = 0; cell < old_count; ++cell) {
      if (refill.is_removed[cell]) change.removed_cells.push_back(cell);
    }
    const int count = old_count - static_cast<int>(change.removed_cells.size()) + made;
    change.cell.assign(count, none);
    SPREKK_ASSERT(count > 0 && made > 0, count, made);
    raw.cells.resize(count);
    std::vector<int> moved;
    for (int cell = 0; cell < old_count; ++cell) {
      if (refill.is_removed[cell]) continue;
      if (cell < count) {
        change.cell[cell] = cell;
      } else {
        moved.push_back(cell);
      }
    }
    // Kept cells with numbers beyond the new count move to the lowest free numbers; new cells get the others.
    int free = 0;
    const auto next_free = [&] {
      while (free < count && change.cell[free] != none) ++free;
      return free;
    };
    for (const int cell : moved) change.cell[next_free()] = cell;
    SPREKK_ASSERT(std::ranges::none_of(change.cell, [&](int cell) { return cell != none && refill.is_removed[cell]; }));
    for (int cell = 0; cell < count; ++cell) {
      if (change.cell[cell] == none) {
        raw.cells[cell] = Ring(refill.triangles[change.new_cells.size()]);
        change.new_cells.push_back(cell);
      } else {
        raw.cells[cell] = raw_.cells[change.cell[cell]];
      }
    }
    measure_overlap(refill, change);
    SPREKK_ASSERT(static_cast<int>(change.new_cells.size()) == made, change.new_cells.size(), made);
    SPREKK_ASSERT(std::ranges::none_of(holder_, [](int holder) { return holder == none; }), holder_.size());
    int next_new = 0;
    for (int cell = 0; cell < count; ++cell) {
      raw.regions.push_back(mesh_.cell_region[ancestor(change, cell, next_new)]);
    }
    for (int face = 0, edge = 0; face < mesh_.face_count(); ++face) {
      if (mesh_.face_side[face] == none) continue;
      if (!refill.is_removed[mesh_.face_cells[face][0]]) raw.boundary_faces.push_back(raw_.boundary_faces[edge]);
      ++edge;
    }
    raw.boundary_faces.insert(raw.boundary_faces.end(), refill.boundary_faces.begin(), refill.boundary_faces.end());
    raw.fractures = raw_.fractures;
    for (std::size_t e = 0; e < extensions_.size(); ++e) {
      auto& chain = raw.fractures[extensions_[e].fracture].nodes;
      SPREKK_ASSERT(path_nodes_.paths[e].size() >= 2, e, path_nodes_.paths[e].size());
      const auto& path = path_nodes_.paths[e];
      if (extensions_[e].at_end) {
        chain.insert(chain.end(), path.begin() + 1, path.end());
      } else {
        chain.insert(chain.begin(), path.rbegin(), path.rend() - 1);
      }
    }
    return raw;
  }

  void measure_overlap(const Refill& refill, const MeshChange& change) {
    std::vector<Corners> made, removed;
    for (const auto& triangle : refill.triangles) made.push_back(corners_of(refill.nodes, Ring(triangle)));
    for (const int cell : change.removed_cells) removed.push_back(corners_of(raw_.nodes, raw_.cells[cell]));
    holder_.assign(made.size(), none);
    std::vector<double> depth(made.size(), -std::numeric_limits<double>::infinity());
    for_each_overlap(made, removed, [&](int i, int j, double area) {
      overlaps_.emplace_back(change.new_cells[i], change.removed_cells[j], area);
      const Point center = (made[i][0] + made[i][1] + made[i][2]) / 3;
      double inside = std::numeric_limits<double>::infinity();
      for (int k = 0; k < removed[j].size(); ++k) {
        const Point along = removed[j].after(k) - removed[j][k];
        inside = std::min(inside, cross(along, center - removed[j][k]) / along.norm());
      }
      if (inside > depth[i]) depth[i] = inside, holder_[i] = change.removed_cells[j];
    });
  }

  /// The old cell that has become a new cell, or that contains the centre of the new cell.
  int ancestor(const MeshChange& change, int cell, int& next_new) const {
    return change.cell[cell] != none ? change.cell[cell] : holder_[next_new++];
  }

  void map_cells(GrownMesh& grown) {
    auto& [mesh, change, angle, extension_cells] = grown;
    std::vector<Triplet> areas = std::move(overlaps_);
    int next_new = 0;
    for (int cell = 0; cell < mesh.cell_count(); ++cell) {
      mesh.cell_rank[cell] = mesh_.cell_rank[ancestor(change, cell, next_new)];
      if (change.cell[cell] != none) areas.emplace_back(cell, change.cell[cell], mesh.cell_measure[cell]);
    }
    change.overlap = matrix_of(mesh.cell_count(), mesh_.cell_count(), areas);
  }

  void map_fractures(GrownMesh& grown) const {
    auto& [mesh, change, angle, extension_cells] = grown;
    change.fracture_cell.assign(mesh.fracture_cell_count(), none);
    std::vector<int> grown_before(mesh_.fractures.size(), 0);  // number of new cells at the first point
    extension_cells.resize(extensions_.size());
    for (std::size_t e = 0; e < extensions_.size(); ++e) {
      const int fracture = extensions_[e].fracture;
      const bool at_end = extensions_[e].at_end;
      const int count = static_cast<int>(paths_[e].size()), first = mesh.fractures[fracture].first_cell;
      if (!at_end) grown_before[fracture] = count;
      const int start = at_end ? first + mesh.fractures[fracture].cell_count - count : first + count - 1;
      for (int i = 0; i < count; ++i) extension_cells[e].push_back(at_end ? start + i : start - i);
    }
    for (std::size_t f = 0; f < mesh_.fractures.size(); ++f) {
      for (int i = 0; i < mesh_.fractures[f].cell_count; ++i) {
        const int now = mesh.fractures[f].first_cell + grown_before[f] + i;
        change.fracture_cell[now] = mesh_.fractures[f].first_cell + i;
      }
    }
    change.ridge = same_ridges(mesh_, mesh, change.fracture_cell);
  }

  void map_faces(const RawMesh& raw, GrownMesh& grown) const {
    auto& [mesh, change, angle, extension_cells] = grown;
    std::map<std::array<int, 2>, int> old_face;  // of the removed cells, without walls
    for (const int cell : change.removed_cells) {
      for (int k = 0; k < mesh_.cell_faces[cell].size(); ++k) {
        const int face = mesh_.cell_faces[cell][k];
        if (mesh_.face_fracture_cell[face] != none) continue;
        old_face[sorted(raw_.cells[cell][k], raw_.cells[cell].after(k))] = face;
      }
    }
    change.face.assign(mesh.face_count(), none);
    for (int cell = 0; cell < mesh.cell_count(); ++cell) {
      const int old = change.cell[cell];
      for (int k = 0; k < mesh.cell_faces[cell].size(); ++k) {
        const int face = mesh.cell_faces[cell][k], fracture_cell = mesh.face_fracture_cell[face];
        if (old != none) {
          change.face[face] = mesh_.cell_faces[old][k];
        } else if (fracture_cell != none) {
          const int old_cell = change.fracture_cell[fracture_cell];
          if (old_cell == none) continue;
          const int wall = mesh.fracture_cells[fracture_cell].faces[0] == face ? 0 : 1;
          change.face[face] = mesh_.fracture_cells[old_cell].faces[wall];
        } else {
          const auto found = old_face.find(sorted(raw.cells[cell][k], raw.cells[cell].after(k)));
          if (found != old_face.end()) change.face[face] = found->second;
        }
      }
    }
  }

  const Mesh& mesh_;
  const CavityOptions options_;
  const std::vector<std::vector<Segment>>& scars_;
  const std::vector<PathExtension> extensions_;
  std::vector<int> merged_;
  const RawMesh raw_;
  const PathNodes path_nodes_;
  std::vector<std::vector<Segment>> paths_;  ///< the edges along each path
  std::vector<Triplet> overlaps_;            ///< of new cells with removed ones
  std::vector<int> holder_;                  ///< per new cell, in their order: the removed cell that holds its centre
};

/// Relates a mesh that was extended after healing to the mesh before healing.
void relate_to_given(const Mesh& given, const HealedMesh& healed, GrownMesh& grown) {
  const auto through = [](const std::vector<int>& origin, std::vector<int>& entities) {
    for (int& entity : entities)
      if (entity != none) entity = origin[entity];
  };
  MeshChange& change = grown.change;
  through(healed.face, change.face);
  through(healed.fracture_cell, change.fracture_cell);
  through(healed.ridge, change.ridge);
  for (std::size_t e = 0; e < healed.replaced.size(); ++e)
    add_replaced_parts(given, healed.replaced[e], grown.mesh, grown.extension_cells[e], change);
}

}  // namespace

void mark_grown_cells(const Mesh& before, GrownMesh& grown) {
  SPREKK_EXPECT(static_cast<int>(grown.change.fracture_cell.size()) == grown.mesh.fracture_cell_count(),
                grown.change.fracture_cell.size(), grown.mesh.fracture_cell_count());
  for (int i = 0; i < grown.mesh.fracture_cell_count(); ++i) {
    const int origin = grown.change.fracture_cell[i];
    grown.mesh.fracture_cells[i].grown = origin == none || before.fracture_cells[origin].grown;
  }
}

GrownMesh extend_fractures(const Mesh& mesh, const std::vector<PathExtension>& extensions,
                           const CavityOptions& options) {
  for (const double value : {options.radius, options.size, options.growth}) {
    if (!(value > 0) || !std::isfinite(value)) {
      throw std::invalid_argument("extend_fractures: radius, size and growth must be positive numbers");
    }
  }
  if (!(options.gap_edges >= 0)) throw std::invalid_argument("extend_fractures: gap_edges must not be negative");
  const bool replaces = std::ranges::any_of(extensions, [](const PathExtension& path) { return path.replaced != 0; });
  if (!replaces) {
    GrownMesh grown = Growth(mesh, extensions, {}, options).run();
    mark_grown_cells(mesh, grown);
    return grown;
  }
  const HealedMesh healed = heal_ends(mesh, extensions);
  std::vector<PathExtension> from_anchors = extensions;
  for (PathExtension& extension : from_anchors) extension.replaced = 0;
  GrownMesh grown = Growth(healed.mesh, from_anchors, healed.scars, options).run();
  relate_to_given(mesh, healed, grown);
  mark_grown_cells(mesh, grown);
  return grown;
}

}  // namespace sprekk
