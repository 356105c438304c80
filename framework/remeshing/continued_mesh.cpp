#include "framework/remeshing/continued_mesh.hpp"

#include <algorithm>
#include <array>
#include <map>

#include "framework/invariants.hpp"
#include "framework/matrix_of.hpp"
#include "framework/mesh/build_mesh.hpp"
#include "framework/mesh/plane/planar.hpp"
#include "framework/remeshing/cavity.hpp"
#include "framework/remeshing/overlap.hpp"
#include "framework/remeshing/replaced_parts.hpp"
#include "framework/remeshing/same_ridges.hpp"
#include "framework/remeshing/sorted_ends.hpp"

namespace sprekk {
namespace {

/// rad, a usual smallest angle of cells that are made anew. It stands for the angle before any move, so that the limit
/// for moved cells is the same however often they move.
constexpr double angle_of_new_cells = 0.56;
constexpr double least_share = 0.1;  ///< of a divided cell: the smallest part; shorter ones make slivers

/// The last cell of a fracture, and its ends.
struct LastCell {
  int cell, anchor, tip;  ///< nodes of the raw mesh
  Point from, to;         ///< m
};

class Continuation {
 public:
  Continuation(const Mesh& mesh, const std::vector<PathExtension>& extensions)
      : mesh_(mesh), extensions_(extensions), raw_(to_raw_mesh(mesh, &merged_)), divided_(mesh.fractures.size()) {}

  std::optional<GrownMesh> run(const CavityOptions& options) {
    if (!std::ranges::all_of(extensions_, [](const PathExtension& extension) { return can_go_on(extension); }))
      return std::nullopt;
    choose_cells(options);
    for (int cell = 0; cell < mesh_.cell_count(); ++cell)
      if (is_free_[cell] && raw_.cells[cell].size() != 3) return std::nullopt;
    for (const PathExtension& extension : extensions_)
      if (extension.points.size() == 2 && !divide(extension)) return std::nullopt;
    return grown();
  }

 private:
  static bool can_go_on(const PathExtension& extension) {
    return extension.replaced == 1 && extension.whole_segments &&
           (extension.points.size() == 1 || (extension.points.size() == 2 && extension.divides));
  }

  LastCell last_cell(const PathExtension& extension) const {
    const Fracture& fracture = mesh_.fractures[extension.fracture];
    const std::vector<int>& chain = raw_.fractures[extension.fracture].nodes;
    const std::size_t end = chain.size() - 1;
    LastCell last{};
    last.cell = extension.at_end ? fracture.first_cell + fracture.cell_count - 1 : fracture.first_cell;
    last.anchor = extension.at_end ? chain[end - 1] : chain[1];
    last.tip = extension.at_end ? chain[end] : chain[0];
    last.from = raw_.nodes[last.anchor];
    last.to = raw_.nodes[last.tip];
    return last;
  }

  void choose_cells(const CavityOptions& options) {
    std::vector<std::vector<Segment>> lines;
    for (const PathExtension& extension : extensions_) {
      const LastCell last = last_cell(extension);
      lines.push_back({{last.from, last.to}});
      Point from = last.from;
      for (const Point& to : extension.points) {
        lines.back().push_back({from, to});
        from = to;
      }
    }
    is_free_ = choose_cavity(mesh_, merged_, lines, std::vector<double>(lines.size(), options.radius));
  }

  /// Adds a node on the last cell, and halves the triangles at both of its walls.
  bool divide(const PathExtension& extension) {
    const LastCell last = last_cell(extension);
    const double length = (last.to - last.from).norm(), share = (extension.points[0] - last.from).norm() / length;
    if (!(share > least_share && share < 1 - least_share)) return false;
    const int node = static_cast<int>(raw_.nodes.size());
    raw_.nodes.push_back(last.from + share * (last.to - last.from));
    for (const int face : mesh_.fracture_cells[last.cell].faces) {
      const int cell = mesh_.face_cells[face][0];
      SPREKK_ASSERT(is_free_[cell], cell);
      Ring other = raw_.cells[cell];
      if (other.size() != 3) return false;
      std::ranges::replace(raw_.cells[cell], last.tip, node);
      std::ranges::replace(other, last.anchor, node);
      raw_.cells.push_back(other);
      raw_.regions.push_back(raw_.regions[cell]);
      origin_.push_back(cell);
    }
    std::vector<int>& chain = raw_.fractures[extension.fracture].nodes;
    chain.insert(extension.at_end ? chain.end() - 1 : chain.begin() + 1, node);
    divided_[extension.fracture][extension.at_end] = 1;
    return true;
  }

  GrownMesh grown() const {
    GrownMesh grown;
    grown.smallest_angle = angle_of_new_cells;
    grown.mesh = build_mesh(raw_);
    Mesh& mesh = grown.mesh;
    MeshChange& change = grown.change;
    const int old_count = mesh_.cell_count();
    change.cell.assign(mesh.cell_count(), none);
    for (int cell = 0; cell < mesh.cell_count(); ++cell) {
      mesh.cell_rank[cell] = mesh_.cell_rank[cell < old_count ? cell : origin_[cell - old_count]];
      if (cell < old_count && !is_free_[cell]) {
        change.cell[cell] = cell;
        continue;
      }
      change.new_cells.push_back(cell);
      if (cell < old_count) change.removed_cells.push_back(cell);
    }
    map_fractures(grown);
    map_faces(grown);
    measure_overlap(grown);
    for (std::size_t e = 0; e < extensions_.size(); ++e)
      add_replaced_parts(mesh_, {last_cell_of_mesh(extensions_[e])}, mesh, grown.extension_cells[e], change);
    mark_grown_cells(mesh_, grown);
    return grown;
  }

  int last_cell_of_mesh(const PathExtension& extension) const {
    const Fracture& fracture = mesh_.fractures[extension.fracture];
    return extension.at_end ? fracture.first_cell + fracture.cell_count - 1 : fracture.first_cell;
  }

  void map_fractures(GrownMesh& grown) const {
    MeshChange& change = grown.change;
    const Mesh& mesh = grown.mesh;
    change.fracture_cell.assign(mesh.fracture_cell_count(), none);
    for (std::size_t f = 0; f < mesh_.fractures.size(); ++f)
      for (int i = 0; i < mesh_.fractures[f].cell_count; ++i)
        change.fracture_cell[mesh.fractures[f].first_cell + divided_[f][0] + i] = mesh_.fractures[f].first_cell + i;
    for (const PathExtension& extension : extensions_) {
      const Fracture& fracture = mesh.fractures[extension.fracture];
      const int count = static_cast<int>(extension.points.size());
      const int start =
          extension.at_end ? fracture.first_cell + fracture.cell_count - count : fracture.first_cell + count - 1;
      std::vector<int>& cells = grown.extension_cells.emplace_back();
      for (int i = 0; i < count; ++i) {
        cells.push_back(extension.at_end ? start + i : start - i);
        change.fracture_cell[cells.back()] = none;
      }
    }
    change.ridge = same_ridges(mesh_, mesh, change.fracture_cell);
  }

  void map_faces(GrownMesh& grown) const {
    MeshChange& change = grown.change;
    const Mesh& mesh = grown.mesh;
    std::map<std::array<int, 2>, int> old_face;  // without walls, by their ends, whose numbers stay
    for (int cell = 0; cell < mesh_.cell_count(); ++cell)
      for (int k = 0; k < mesh_.cell_faces[cell].size(); ++k) {
        const auto [a, b] = mesh_.face_nodes[mesh_.cell_faces[cell][k]];
        if (mesh_.face_fracture_cell[mesh_.cell_faces[cell][k]] == none)
          old_face[sorted(merged_[a], merged_[b])] = mesh_.cell_faces[cell][k];
      }
    std::vector<int> merged;
    to_raw_mesh(mesh, &merged);
    change.face.assign(mesh.face_count(), none);
    for (int face = 0; face < mesh.face_count(); ++face) {
      if (const int wall_of = mesh.face_fracture_cell[face]; wall_of != none) {
        const int old = change.fracture_cell[wall_of];
        if (old == none) continue;
        const int wall = mesh.fracture_cells[wall_of].faces[0] == face ? 0 : 1;
        change.face[face] = mesh_.fracture_cells[old].faces[wall];
      } else {
        const auto [a, b] = mesh.face_nodes[face];
        const auto found = old_face.find(sorted(merged[a], merged[b]));
        if (found != old_face.end()) change.face[face] = found->second;
      }
    }
  }

  void measure_overlap(GrownMesh& grown) const {
    MeshChange& change = grown.change;
    std::vector<Triplet> areas;
    const int old_count = mesh_.cell_count();
    for (int cell = 0; cell < grown.mesh.cell_count(); ++cell)
      areas.emplace_back(cell, cell < old_count ? cell : origin_[cell - old_count], grown.mesh.cell_measure[cell]);
    change.overlap = matrix_of(grown.mesh.cell_count(), old_count, areas);
  }

  const Mesh& mesh_;
  const std::vector<PathExtension>& extensions_;
  std::vector<int> merged_;
  RawMesh raw_;
  std::vector<bool> is_free_;                ///< per old cell: whether it may move
  std::vector<int> origin_;                  ///< per cell beyond the old ones: the old cell that it is a part of
  std::vector<std::array<int, 2>> divided_;  ///< per fracture and end
};

}  // namespace

std::optional<GrownMesh> continued_mesh(const Mesh& mesh, const std::vector<PathExtension>& extensions,
                                        const CavityOptions& options) {
  return Continuation(mesh, extensions).run(options);
}

}  // namespace sprekk
