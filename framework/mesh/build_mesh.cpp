#include "framework/mesh/build_mesh.hpp"

#include <algorithm>
#include <atomic>
#include <map>
#include <numeric>
#include <string>

#include "framework/config/input_error.hpp"
#include "framework/invariants.hpp"
#include "framework/mesh/expect_sound_mesh.hpp"
#include "framework/mesh/face_table.hpp"
#include "framework/mesh/fracture_ridges.hpp"
#include "framework/mesh/geometry.hpp"
#include "framework/mesh/oriented_cells.hpp"
#include "framework/mesh/outer_ridges.hpp"

namespace sprekk {
namespace {

/// Builds one mesh; the members are the intermediate results that the steps share.
class MeshBuilder {
 public:
  explicit MeshBuilder(const RawMesh& raw)
      : raw_(raw), cells_(oriented_cells(raw)), faces_(raw.nodes, cells_), fracture_cell_(faces_.size(), none) {}

  Mesh build() {
    name_sides_and_regions();
    outer_ = OuterRidges(raw_, faces_);
    read_fractures();
    number_nodes();
    number_faces();
    place_fracture_cells();
    ridges_.add_to(mesh_, raw_, outer_);
    mesh_.node_cells = invert(mesh_.cell_nodes);
    mesh_.node_faces = invert(mesh_.face_nodes);
    compute_geometry();
    mesh_.cell_rank.assign(mesh_.cell_count(), 0);
    mesh_.version = next_mesh_version();
    return std::move(mesh_);
  }

 private:
  void name_sides_and_regions() {
    if (raw_.regions.size() != raw_.cells.size()) {
      throw std::logic_error("raw mesh: " + std::to_string(raw_.regions.size()) + " regions for " +
                             std::to_string(raw_.cells.size()) + " cells");
    }
    for (const int region : raw_.regions) {
      if (region < 0 || region >= static_cast<int>(raw_.region_names.size())) {
        throw std::logic_error("raw mesh: region " + std::to_string(region) + " has no name");
      }
    }
    mesh_.side_names = raw_.side_names;
    mesh_.region_names = raw_.region_names;
    mesh_.cell_region = raw_.regions;
  }

  void read_fractures() {
    for (int fracture = 0; fracture < static_cast<int>(raw_.fractures.size()); ++fracture) {
      const std::string& name = raw_.fractures[fracture].name;
      const std::vector<FaceNodes> faces = faces_of(raw_, raw_.fractures[fracture]);
      ridges_.add(raw_, fracture, faces, outer_);
      mesh_.fractures.push_back({name, mesh_.fracture_cell_count(), static_cast<int>(faces.size())});
      for (const FaceNodes& nodes : faces) {
        const int face = faces_.find(nodes);
        if (face == none) {
          throw InputError("fracture '" + name + "' leaves the " + (dimension == 2 ? "edges" : "faces") +
                           " of the mesh between " + to_text(raw_.nodes[nodes[0]]) + " and " +
                           to_text(raw_.nodes[nodes[1]]));
        }
        if (faces_.is_outer(face))
          throw InputError("fracture '" + name + "' runs along the outer boundary at " + middle(face));
        if (fracture_cell_[face] != none) {
          const int other = mesh_.fracture_cells[fracture_cell_[face]].fracture;
          throw InputError("fractures '" + raw_.fractures[other].name + "' and '" + name + "' run along the same " +
                           face_name + " at " + middle(face) +
                           " (fractures may touch and cross, but not overlap) end one where they meet");
        }
        fracture_cell_[face] = mesh_.fracture_cell_count();
        mesh_.fracture_cells.push_back({fracture, {}, nodes, Point::Zero(), 0, Point::Zero(), Tangents::Zero()});
        fracture_faces_.push_back(nodes);
      }
    }
  }

  void number_nodes() {
    std::vector<int> number(raw_.nodes.size(), none);
    for (const CellNodes& cell : cells_) {
      for (const int node : cell) number[node] = 0;
    }
    for (std::size_t node = 0; node < raw_.nodes.size(); ++node) {
      if (number[node] == none) continue;
      number[node] = mesh_.node_count();
      mesh_.nodes.push_back(raw_.nodes[node]);
    }
    mesh_.cell_nodes = cells_;
    for (auto& cell : mesh_.cell_nodes) {
      for (int& node : cell) node = number[node];
    }
    split_nodes();
  }

  void split_nodes() {
    std::vector<int> place(raw_.nodes.size(), none);
    std::vector<int> nodes;  // of fractures, each once
    for (const FaceNodes& face : fracture_faces_) {
      for (const int node : face) {
        if (place[node] != none) continue;
        place[node] = static_cast<int>(nodes.size());
        nodes.push_back(node);
      }
    }
    if (nodes.empty()) return;
    std::vector<std::vector<int>> cells_at(nodes.size());
    for (int cell = 0; cell < mesh_.cell_count(); ++cell) {
      for (const int node : cells_[cell]) {
        if (place[node] != none) cells_at[place[node]].push_back(cell);
      }
    }
    for (std::size_t i = 0; i < nodes.size(); ++i) split_node(nodes[i], cells_at[i]);
  }

  /// Gives each group of cells that are connected through faces at the node, fractures left out, a node of its own.
  /// `cells` are those at the raw node, ascending.
  void split_node(int node, const std::vector<int>& cells) {
    std::vector<int> group(cells.size(), none);
    for (std::size_t first = 0, groups = 0; first < cells.size(); ++first) {
      if (group[first] != none) continue;
      const int copy = groups++ == 0 ? none : mesh_.node_count();
      if (copy != none) mesh_.nodes.push_back(raw_.nodes[node]);
      std::vector<std::size_t> front{first};
      group[first] = static_cast<int>(groups);
      while (!front.empty()) {
        const int cell = cells[front.back()];
        front.pop_back();
        if (copy != none) mesh_.cell_nodes[cell][place_in(cells_[cell], node)] = copy;
        for (const int face : faces_.of_cell(cell)) {
          if (fracture_cell_[face] != none || faces_.is_outer(face) || !has(faces_.nodes(face), node)) continue;
          const auto [one, other] = faces_.cells(face);
          const auto next = std::lower_bound(cells.begin(), cells.end(), one == cell ? other : one) - cells.begin();
          if (group[next] != none) continue;
          group[next] = static_cast<int>(groups);
          front.push_back(next);
        }
      }
    }
  }

  static bool has(const FaceNodes& face, int node) { return std::find(face.begin(), face.end(), node) != face.end(); }
  static int place_in(const CellNodes& cell, int node) {
    return static_cast<int>(std::find(cell.begin(), cell.end(), node) - cell.begin());
  }

  void number_faces() {
    std::vector<int> number(faces_.size(), none);
    const std::size_t expected = faces_.size() + mesh_.fracture_cells.size();
    mesh_.face_nodes.reserve(expected);
    mesh_.face_cells.reserve(expected);
    mesh_.cell_faces.reserve(mesh_.cell_count());
    for (int cell = 0; cell < mesh_.cell_count(); ++cell) {
      mesh_.cell_faces.push_back(faces_.of_cell(cell));
      int k = 0;
      for (int& face : mesh_.cell_faces.back()) {
        const int raw_face = face, fracture_cell = fracture_cell_[raw_face];
        face = fracture_cell != none ? none : number[raw_face];
        if (face == none) {
          face = number[raw_face] = mesh_.face_count();
          mesh_.face_nodes.push_back(nodes_of_face(mesh_.cell_nodes[cell], k));
          mesh_.face_cells.push_back({cell, none});
          mesh_.face_side.push_back(outer_.side_of_face(raw_face));
          mesh_.face_fracture_cell.push_back(fracture_cell);
          if (fracture_cell != none) set_wall(fracture_cell, face, nodes_of_face(cells_[cell], k));
        } else {
          mesh_.face_cells[face][1] = cell;
        }
        ++k;
      }
    }
  }

  /// The cell that has the face as the fracture has it lies on the plus side.
  void set_wall(int fracture_cell, int face, const FaceNodes& as_cell_has_it) {
    const Wall wall = turn_alike(as_cell_has_it, fracture_faces_[fracture_cell]) ? Wall::plus : Wall::minus;
    mesh_.fracture_cells[fracture_cell].faces[static_cast<int>(wall)] = face;
  }

  void place_fracture_cells() {
    for (std::size_t i = 0; i < fracture_faces_.size(); ++i) {
      const FaceGeometry geometry = face_geometry(raw_.nodes, fracture_faces_[i]);
      FractureCell& cell = mesh_.fracture_cells[i];
      cell.center = geometry.center;
      cell.measure = geometry.measure;
      cell.normal = geometry.normal;
      cell.tangents = tangents_of(geometry.normal);
    }
  }

  template <class Lists>
  Adjacency invert(const Lists& nodes_of) const {
    Adjacency at_node;
    at_node.offsets.assign(mesh_.nodes.size() + 1, 0);
    for (const auto& nodes : nodes_of) {
      for (const int node : nodes) ++at_node.offsets[node + 1];
    }
    std::partial_sum(at_node.offsets.begin(), at_node.offsets.end(), at_node.offsets.begin());
    at_node.items.resize(at_node.offsets.back());
    auto next = at_node.offsets;
    for (int i = 0; i < static_cast<int>(nodes_of.size()); ++i) {
      for (const int node : nodes_of[i]) at_node.items[next[node]++] = i;
    }
    return at_node;
  }

  void compute_geometry() {
    mesh_.cell_center.reserve(mesh_.cell_count());
    mesh_.cell_measure.reserve(mesh_.cell_count());
    for (const CellNodes& cell : mesh_.cell_nodes) {
      const auto [center, measure] = cell_geometry(mesh_.nodes, cell);
      mesh_.cell_center.push_back(center);
      mesh_.cell_measure.push_back(measure);
    }
    mesh_.face_center.reserve(mesh_.face_count());
    mesh_.face_measure.reserve(mesh_.face_count());
    mesh_.face_normal.reserve(mesh_.face_count());
    for (const FaceNodes& face : mesh_.face_nodes) {
      const auto [center, measure, normal] = face_geometry(mesh_.nodes, face);
      mesh_.face_center.push_back(center);
      mesh_.face_measure.push_back(measure);
      mesh_.face_normal.push_back(normal);
    }
  }

  std::string middle(int face) const { return to_text(face_geometry(raw_.nodes, faces_.nodes(face)).center); }

  const RawMesh& raw_;
  const std::vector<CellNodes> cells_;  ///< in the order of their shapes, with raw nodes
  const FaceTable faces_;
  OuterRidges outer_;
  FractureRidges ridges_;
  std::vector<int> fracture_cell_;         ///< whose walls the face becomes, or none
  std::vector<FaceNodes> fracture_faces_;  ///< of each fracture cell, with raw nodes, as the plus side has them
  Mesh mesh_;
};

}  // namespace

Mesh build_mesh(const RawMesh& raw) {
  Mesh mesh = MeshBuilder(raw).build();
  expect_sound(mesh);
  return mesh;
}

std::uint64_t next_mesh_version() {
  static std::atomic<std::uint64_t> last{0};
  return ++last;
}

}  // namespace sprekk
