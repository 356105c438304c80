#include "framework/mesh/build_mesh.hpp"

#include <algorithm>
#include <atomic>
#include <map>
#include <numeric>
#include <string>

#include "framework/config/input_error.hpp"
#include "framework/mesh/add_junction.hpp"
#include "framework/mesh/cell_edges.hpp"
#include "framework/mesh/cell_shape.hpp"
#include "framework/mesh/counter_clockwise.hpp"
#include "framework/mesh/expect_sound_mesh.hpp"
#include "framework/mesh/medium.hpp"
#include "framework/mesh/planar.hpp"

namespace sprekk {
namespace {

/// Builds one mesh; the members are the intermediate results that the steps share.
class MeshBuilder {
 public:
  explicit MeshBuilder(const RawMesh& raw)
      : raw_(raw),
        cells_(counter_clockwise(raw)),
        edges_(raw.nodes, cells_),
        edge_side_(edges_.size(), none),
        edge_fracture_cell_(edges_.size(), none),
        outer_edges_at_node_(raw.nodes.size(), 0),
        fracture_of_node_(raw.nodes.size(), none),
        is_junction_(raw.nodes.size(), false) {}

  Mesh build() {
    name_sides_and_regions();
    read_boundary();
    read_fractures();
    number_nodes();
    number_faces();
    place_fracture_cells();
    list_neighbours_of_nodes();
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

  void read_boundary() {
    for (const auto& [nodes, side] : raw_.boundary_edges) {
      if (side < 0 || side >= static_cast<int>(raw_.side_names.size())) {
        throw std::logic_error("raw mesh: side " + std::to_string(side) + " has no name");
      }
      const std::string name = "side '" + raw_.side_names[side] + "'";
      const int edge = edges_.find(nodes[0], nodes[1]);
      if (edge == none)
        throw InputError(name + " has an edge that no cell has (between nodes " + std::to_string(nodes[0]) + " and " +
                         std::to_string(nodes[1]) + ")");
      if (!edges_.is_outer(edge)) throw InputError(name + " has an edge inside the mesh at " + middle(edge));
      if (edge_side_[edge] != none && edge_side_[edge] != side) {
        throw InputError("the edge at " + middle(edge) + " belongs to two sides ('" +
                         raw_.side_names[edge_side_[edge]] + "' and '" + raw_.side_names[side] + "')");
      }
      edge_side_[edge] = side;
    }
    for (int edge = 0; edge < edges_.size(); ++edge) {
      if (!edges_.is_outer(edge)) continue;
      if (edge_side_[edge] == none) throw InputError("the outer edge at " + middle(edge) + " belongs to no side");
      for (const int node : edges_.nodes(edge)) ++outer_edges_at_node_[node];
    }
    for (std::size_t node = 0; node < raw_.nodes.size(); ++node) {
      if (outer_edges_at_node_[node] > 2) {
        throw InputError("the outer boundary touches itself at " + to_text(raw_.nodes[node]) +
                         " (cells meet there in one node only)");
      }
    }
  }

  void read_fractures() {
    for (int fracture = 0; fracture < static_cast<int>(raw_.fractures.size()); ++fracture) {
      const auto& [name, chain] = raw_.fractures[fracture];
      if (chain.size() < 2) throw InputError("fracture '" + name + "' has no edge");
      for (std::size_t i = 0; i < chain.size(); ++i) claim_node(fracture, chain, i);
      mesh_.fractures.push_back({name, mesh_.fracture_cell_count(), static_cast<int>(chain.size()) - 1});
      for (std::size_t i = 0; i + 1 < chain.size(); ++i) {
        const int edge = edges_.find(chain[i], chain[i + 1]);
        if (edge == none) {
          throw InputError("fracture '" + name + "' leaves the edges of the mesh between " +
                           to_text(raw_.nodes[chain[i]]) + " and " + to_text(raw_.nodes[chain[i + 1]]));
        }
        if (edges_.is_outer(edge)) {
          throw InputError("fracture '" + name + "' runs along the outer boundary at " + middle(edge));
        }
        if (edge_fracture_cell_[edge] != none) {
          const int other = mesh_.fracture_cells[edge_fracture_cell_[edge]].fracture;
          throw InputError("fractures '" + raw_.fractures[other].name + "' and '" + name +
                           "' run along the same edge at " + middle(edge) +
                           " (fractures may touch and cross, but not overlap) end one where they meet");
        }
        edge_fracture_cell_[edge] = mesh_.fracture_cell_count();
        mesh_.fracture_cells.push_back({fracture, {}, {}, Point::Zero(), 0, Point::Zero(), Point::Zero()});
      }
    }
  }

  void claim_node(int fracture, const std::vector<int>& chain, std::size_t i) {
    const std::string& name = raw_.fractures[fracture].name;
    const int node = chain[i];
    if (node < 0 || node >= static_cast<int>(raw_.nodes.size())) {
      throw InputError("fracture '" + name + "' names node " + std::to_string(node) + ", which does not exist");
    }
    const std::string where = " at " + to_text(raw_.nodes[node]);
    if (fracture_of_node_[node] == fracture) {
      throw InputError("fracture '" + name + "' meets itself" + where +
                       " (loops and branches are not supported) leave a gap or make it two fractures");
    }
    if (fracture_of_node_[node] != none) {
      if (outer_edges_at_node_[node] > 0) {
        throw InputError("fractures '" + raw_.fractures[fracture_of_node_[node]].name + "' and '" + name + "' meet" +
                         where + " (fractures may not meet on the outer boundary) let them meet inside of the " +
                         medium_name());
      }
      is_junction_[node] = true;
    }
    const bool is_end = i == 0 || i + 1 == chain.size();
    if (!is_end && outer_edges_at_node_[node] > 0) {
      throw InputError("fracture '" + name + "' touches the outer boundary" + where +
                       " (only its ends may lie on the boundary)");
    }
    fracture_of_node_[node] = fracture;
  }

  void number_nodes() {
    std::vector<int> number(raw_.nodes.size(), none);
    for (const Ring& cell : cells_) {
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
    std::vector<std::vector<int>> cells_at;
    for (const auto& [name, chain] : raw_.fractures) {
      for (const int node : chain) {
        if (place[node] != none) continue;
        place[node] = static_cast<int>(cells_at.size());
        cells_at.emplace_back();
      }
    }
    if (cells_at.empty()) return;
    for (int cell = 0; cell < mesh_.cell_count(); ++cell) {
      for (const int node : cells_[cell]) {
        if (place[node] != none) cells_at[place[node]].push_back(cell);
      }
    }
    for (const auto& [name, chain] : raw_.fractures) {
      for (const int node : chain) {
        if (place[node] == none) continue;
        split_node(node, cells_at[place[node]]);
        place[node] = none;
      }
    }
  }

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
        for (int k = 0; k < cells_[cell].size(); ++k) {
          if (cells_[cell][k] != node) {
            if (cells_[cell].after(k) != node) continue;
          } else if (copy != none) {
            mesh_.cell_nodes[cell][k] = copy;
          }
          const int edge = edges_.of_cell(cell)[k];
          if (edge_fracture_cell_[edge] != none || edges_.is_outer(edge)) continue;
          const auto [one, other] = edges_.cells(edge);
          const auto next = std::lower_bound(cells.begin(), cells.end(), one == cell ? other : one) - cells.begin();
          if (group[next] != none) continue;
          group[next] = static_cast<int>(groups);
          front.push_back(next);
        }
      }
    }
  }

  void number_faces() {
    std::vector<int> face_of_edge(edges_.size(), none);
    mesh_.cell_faces = mesh_.cell_nodes;  // as long as they are
    const std::size_t expected = edges_.size() + mesh_.fracture_cells.size();
    mesh_.face_nodes.reserve(expected);
    mesh_.face_cells.reserve(expected);
    for (int cell = 0; cell < mesh_.cell_count(); ++cell) {
      const Ring& nodes = mesh_.cell_nodes[cell];
      for (int k = 0; k < nodes.size(); ++k) {
        const int edge = edges_.of_cell(cell)[k];
        const bool is_wall = edge_fracture_cell_[edge] != none;
        int face = is_wall ? none : face_of_edge[edge];
        if (face == none) {
          face = face_of_edge[edge] = mesh_.face_count();
          mesh_.face_nodes.push_back({nodes[k], nodes.after(k)});
          mesh_.face_cells.push_back({cell, none});
          mesh_.face_side.push_back(edge_side_[edge]);
          mesh_.face_fracture_cell.push_back(edge_fracture_cell_[edge]);
        } else {
          mesh_.face_cells[face][1] = cell;
        }
        mesh_.cell_faces[cell][k] = face;
      }
    }
  }

  void place_fracture_cells() {
    std::map<int, std::vector<FractureCellEnd>> ends_at;  // by the raw node of a junction
    for (int fracture = 0; fracture < static_cast<int>(raw_.fractures.size()); ++fracture) {
      const auto& chain = raw_.fractures[fracture].nodes;
      const int first_cell = mesh_.fractures[fracture].first_cell;
      const int last = static_cast<int>(chain.size()) - 1;
      for (int i = 0; i <= last; ++i) {
        const int point = static_cast<int>(mesh_.fracture_points.size());
        if (i > 0) mesh_.fracture_cells[first_cell + i - 1].points[1] = point;
        if (i < last) mesh_.fracture_cells[first_cell + i].points[0] = point;
        const bool is_end = i == 0 || i == last;
        if (is_junction_[chain[i]]) {
          if (i > 0) ends_at[chain[i]].push_back({first_cell + i - 1, 1});
          if (i < last) ends_at[chain[i]].push_back({first_cell + i, 0});
          if (is_end) continue;
        }
        mesh_.fracture_points.push_back(fracture_point(chain[i], first_cell, i, last));
      }
      for (int i = 0; i < last; ++i) place_fracture_cell(mesh_.fracture_cells[first_cell + i], chain[i], chain[i + 1]);
    }
    // In the order of fractures, so that the result does not depend on how the nodes are numbered.
    for (const auto& [name, chain] : raw_.fractures) {
      for (const int node : chain) {
        const auto found = ends_at.find(node);
        if (found == ends_at.end()) continue;
        add_junction(mesh_, raw_.nodes[node], found->second);
        ends_at.erase(found);
      }
    }
  }

  void place_fracture_cell(FractureCell& cell, int first, int second) {
    const Point &from = raw_.nodes[first], &to = raw_.nodes[second];
    cell.center = 0.5 * (from + to);
    cell.measure = (to - from).norm();
    cell.tangents = (to - from) / cell.measure;
    cell.normal = {cell.tangents.y(), -cell.tangents.x()};
    const int edge = edges_.find(first, second);
    for (const int side : edges_.cells(edge)) {
      for (int k = 0; k < cells_[side].size(); ++k) {
        if (edges_.of_cell(side)[k] != edge) continue;
        // The cell that runs along the edge in the chain's direction lies to its left: the plus side.
        const Wall wall = cells_[side][k] == first ? Wall::plus : Wall::minus;
        cell.faces[static_cast<int>(wall)] = mesh_.cell_faces[side][k];
      }
    }
  }

  FracturePoint fracture_point(int node, int first_cell, int i, int last) const {
    FracturePoint point{raw_.nodes[node], {}, FracturePoint::Kind::inside, none};
    if (i > 0) point.cells.push_back(first_cell + i - 1);
    if (i < last) point.cells.push_back(first_cell + i);
    if (is_junction_[node]) point.kind = FracturePoint::Kind::junction;
    if (is_junction_[node] || point.cells.size() == 2) return point;
    point.kind = outer_edges_at_node_[node] > 0 ? FracturePoint::Kind::on_boundary : FracturePoint::Kind::tip;
    if (point.kind == FracturePoint::Kind::on_boundary) point.side = side_at(node);
    return point;
  }

  /// At a corner between two sides: the one with the smaller index.
  int side_at(int node) const {
    int side = none;
    for (const auto& edge : raw_.boundary_edges) {
      if (edge.nodes[0] != node && edge.nodes[1] != node) continue;
      if (side == none || edge.side < side) side = edge.side;
    }
    return side;
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

  void list_neighbours_of_nodes() {
    mesh_.node_cells = invert(mesh_.cell_nodes);
    mesh_.node_faces = invert(mesh_.face_nodes);
  }

  void compute_geometry() {
    mesh_.cell_center.reserve(mesh_.cell_count());
    mesh_.cell_measure.reserve(mesh_.cell_count());
    for (const Ring& cell : mesh_.cell_nodes) {
      mesh_.cell_center.push_back(centroid(mesh_.nodes, cell));
      mesh_.cell_measure.push_back(signed_area(mesh_.nodes, cell));
    }
    mesh_.face_center.reserve(mesh_.face_count());
    mesh_.face_measure.reserve(mesh_.face_count());
    mesh_.face_normal.reserve(mesh_.face_count());
    for (const auto& [a, b] : mesh_.face_nodes) {
      const Point along = mesh_.nodes[b] - mesh_.nodes[a];
      mesh_.face_center.push_back(0.5 * (mesh_.nodes[a] + mesh_.nodes[b]));
      mesh_.face_measure.push_back(along.norm());
      mesh_.face_normal.push_back(Point(along.y(), -along.x()) / along.norm());
    }
  }

  std::string middle(int edge) const {
    return to_text(0.5 * (raw_.nodes[edges_.nodes(edge)[0]] + raw_.nodes[edges_.nodes(edge)[1]]));
  }

  const RawMesh& raw_;
  const std::vector<Ring> cells_;  ///< counter-clockwise, with raw nodes
  const CellEdges edges_;
  std::vector<int> edge_side_;
  std::vector<int> edge_fracture_cell_;
  std::vector<int> outer_edges_at_node_;
  std::vector<int> fracture_of_node_;  ///< the last one that claimed it
  std::vector<bool> is_junction_;
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
