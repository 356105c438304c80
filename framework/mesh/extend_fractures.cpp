#include "framework/mesh/extend_fractures.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>
#include <numbers>
#include <stdexcept>

#include "framework/mesh/build_mesh.hpp"
#include "framework/mesh/cavity.hpp"
#include "framework/mesh/fill_cavity.hpp"
#include "framework/mesh/graded_division.hpp"
#include "framework/mesh/overlap.hpp"
#include "framework/mesh/path_nodes.hpp"
#include "framework/mesh/planar.hpp"

namespace sprekk {
namespace {

using Place = CavityOutline::Edge::Place;

/// Below this angle (rad) other methods and larger cavities are tried.
constexpr double wanted_angle = 25 * std::numbers::pi / 180;
struct Attempt {
  double enlargement;  ///< of the radius
  MeshMethod method;
};
constexpr Attempt attempts[] = {{1, MeshMethod::frontal},     {1, MeshMethod::delaunay},  {1.25, MeshMethod::frontal},
                                {1.25, MeshMethod::delaunay}, {1.6, MeshMethod::frontal}, {2, MeshMethod::frontal}};
/// So many attempts in a row without gain are the last: small angles between lines that must stay remain.
constexpr int most_vain_attempts = 2;
/// An edge of an interface is divided when it is so many times longer than the gap between it and a path.
constexpr double too_long = 1.5;

std::array<int, 2> sorted(int a, int b) { return {std::min(a, b), std::max(a, b)}; }

/// New triangles for the cavity, with the numbers of nodes that are in `nodes`.
struct Refill {
  std::vector<bool> is_removed;  ///< per old cell
  std::vector<Point> nodes;
  std::vector<std::array<int, 3>> triangles;
  std::vector<RawMesh::BoundaryEdge> boundary_edges;  ///< of the new triangles
  double smallest_angle = std::numeric_limits<double>::infinity();
  int single_corners = 0;

  bool is_good() const { return single_corners == 0 && smallest_angle >= wanted_angle; }
  bool is_better_than(const Refill& other) const {
    if (single_corners != other.single_corners) return single_corners < other.single_corners;
    return smallest_angle > other.smallest_angle;
  }
};

class Growth {
 public:
  Growth(const Mesh& mesh, const std::vector<PathExtension>& extensions, const CavityOptions& options)
      : mesh_(mesh),
        options_(options),
        extensions_(check_extensions(mesh, extensions, options.size)),
        raw_(to_raw_mesh(mesh, &merged_)),
        path_nodes_(place_path_nodes(mesh, raw_, merged_, extensions_, options.size)) {
    for (const auto& path : path_nodes_.paths) {
      paths_.emplace_back();
      for (std::size_t i = 0; i + 1 < path.size(); ++i) {
        paths_.back().push_back({path_nodes_.nodes[path[i]], path_nodes_.nodes[path[i + 1]]});
      }
    }
  }

  GrownMesh run() {
    const Refill refill = best_refill();
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
  Refill best_refill() const {
    Refill best;
    bool has_one = false;
    std::string failure;
    int in_vain = 0;
    for (const auto& [enlargement, method] : attempts) {
      try {
        Refill next = refill(enlargement * options_.radius, method);
        in_vain = !has_one || next.is_better_than(best) ? 0 : in_vain + 1;
        if (in_vain == 0) best = std::move(next);
        has_one = true;
        if (best.is_good() || in_vain == most_vain_attempts) break;
      } catch (const std::runtime_error& error) {
        failure = error.what();
      }
    }
    if (!has_one) throw std::runtime_error("fractures cannot be extended: " + failure);
    return best;
  }

  Refill refill(double radius, MeshMethod method) const {
    Refill refill;
    refill.nodes = path_nodes_.nodes;
    refill.is_removed = choose_cavity(mesh_, merged_, paths_, std::vector<double>(paths_.size(), radius));
    const std::vector<int> part = connected_parts(mesh_, refill.is_removed);
    std::vector<std::vector<int>> cells;
    for (int cell = 0; cell < mesh_.cell_count(); ++cell) {
      if (part[cell] == none) continue;
      if (part[cell] == static_cast<int>(cells.size())) cells.emplace_back();
      cells[part[cell]].push_back(cell);
    }
    std::vector<int> part_of_path;
    for (const auto& path : paths_) part_of_path.push_back(part_met(path, cells));
    for (std::size_t p = 0; p < cells.size(); ++p) fill(cells[p], static_cast<int>(p), part_of_path, method, refill);
    return refill;
  }

  int part_met(const std::vector<Segment>& path, const std::vector<std::vector<int>>& cells) const {
    for (std::size_t p = 0; p < cells.size(); ++p) {
      for (const int cell : cells[p]) {
        if (meets_cell(mesh_, cell, path.front())) return static_cast<int>(p);
      }
    }
    throw std::runtime_error("a path lies outside of the mesh");
  }

  /// Collects the edges that stay in and around one cavity.
  class Outline {
   public:
    explicit Outline(const std::vector<Point>& nodes) : nodes_(nodes) {}

    void add(int from, int to, Place place, bool is_barrier) {
      const auto [entry, is_new] = edge_of_.try_emplace(sorted(from, to), outline_.edges.size());
      if (is_new) {
        outline_.edges.push_back({{local(from), local(to)}, place, is_barrier});
      } else if (is_barrier) {
        outline_.edges[entry->second].is_barrier = true;
      }
    }
    const CavityOutline& get() const { return outline_; }
    const std::vector<int>& nodes() const { return node_of_; }

   private:
    int local(int node) {
      const auto [entry, is_new] = local_.try_emplace(node, static_cast<int>(node_of_.size()));
      if (is_new) {
        node_of_.push_back(node);
        outline_.points.push_back(nodes_[node]);
      }
      return entry->second;
    }
    const std::vector<Point>& nodes_;
    CavityOutline outline_;
    std::vector<int> node_of_;
    std::map<int, int> local_;
    std::map<std::array<int, 2>, std::size_t> edge_of_;
  };

  /// Of the outer boundary, counter-clockwise.
  struct OuterEdge {
    std::vector<int> nodes;  ///< its ends and what lies between them
    int side, region;
  };

  static bool are_in_line(const OuterEdge& a, const OuterEdge& b, const std::vector<Point>& nodes) {
    const Point u = nodes[a.nodes.back()] - nodes[a.nodes.front()], v = nodes[b.nodes.back()] - nodes[b.nodes.front()];
    return a.side == b.side && a.region == b.region && std::abs(cross(u, v)) <= 1e-14 * u.norm() * v.norm();
  }

  void fill(const std::vector<int>& cells, int part, const std::vector<int>& part_of_path, MeshMethod method,
            Refill& refill) const {
    Outline outline(refill.nodes);
    std::vector<OuterEdge> outer_edges;
    for (std::size_t p = 0; p < part_of_path.size(); ++p) {
      if (part_of_path[p] != part) continue;
      const auto& path = path_nodes_.paths[p];
      for (std::size_t i = 0; i + 1 < path.size(); ++i) outline.add(path[i], path[i + 1], Place::inside, true);
    }
    for (const int cell : cells) {
      for (int k = 0; k < 3; ++k) {
        const int face = mesh_.cell_faces[cell][k], next = cell_across(mesh_, cell, k);
        const int a = merged_[mesh_.cell_nodes[cell][k]], b = merged_[mesh_.cell_nodes[cell][(k + 1) % 3]];
        const bool is_fracture = mesh_.face_fracture_cell[face] != none;
        if (next == none) {
          outer_edges.push_back(
              {with_added_nodes(face, a, b, refill.nodes), mesh_.face_side[face], mesh_.cell_region[cell]});
        } else if (!refill.is_removed[next]) {
          outline.add(a, b, Place::rim, is_fracture);
        } else if (is_fracture) {
          outline.add(a, b, Place::inside, true);
        } else if (mesh_.cell_region[cell] != mesh_.cell_region[next]) {
          if (cell > next) continue;  // an edge that is divided must be so once
          const std::vector<int> nodes = divide_interface(face, a, b, refill.nodes);
          for (std::size_t i = 0; i + 1 < nodes.size(); ++i) outline.add(nodes[i], nodes[i + 1], Place::inside, false);
        }
      }
    }
    join_at_path_ends(outer_edges, refill.nodes);
    for (const OuterEdge& edge : outer_edges) {
      const std::vector<int> nodes = divide_outer_edge(edge.nodes, refill.nodes);
      for (std::size_t i = 0; i + 1 < nodes.size(); ++i) {
        outline.add(nodes[i], nodes[i + 1], Place::rim, true);
        refill.boundary_edges.push_back({{nodes[i], nodes[i + 1]}, edge.side});
      }
    }
    const Triangulation filling = fill_cavity(outline.get(), options_.growth, method);
    refill.smallest_angle = std::min(refill.smallest_angle, smallest_angle(filling));
    refill.single_corners += single_corner_count(filling);
    std::vector<int> node_of = outline.nodes();
    for (std::size_t i = node_of.size(); i < filling.points.size(); ++i) {
      node_of.push_back(static_cast<int>(refill.nodes.size()));
      refill.nodes.push_back(filling.points[i]);
    }
    for (const auto& [a, b, c] : filling.triangles) refill.triangles.push_back({node_of[a], node_of[b], node_of[c]});
  }

  /// a, what lies on the face, b.
  std::vector<int> with_added_nodes(int face, int a, int b, const std::vector<Point>& nodes) const {
    std::vector<int> chain{a};
    if (const auto added = path_nodes_.on_face.find(face); added != path_nodes_.on_face.end()) {
      chain.insert(chain.end(), added->second.begin(), added->second.end());
      std::sort(chain.begin() + 1, chain.end(), [&](int p, int q) {
        return (nodes[p] - nodes[a]).dot(nodes[b] - nodes[a]) < (nodes[q] - nodes[a]).dot(nodes[b] - nodes[a]);
      });
    }
    chain.push_back(b);
    return chain;
  }

  /// So that it has edges no longer than what is between it and a path, where that is little.
  std::vector<int> divide_interface(int face, int a, int b, std::vector<Point>& nodes) const {
    std::vector<int> chain = with_added_nodes(face, a, b, nodes);
    for (std::size_t i = 0; i + 1 < chain.size();) {
      const Segment piece{nodes[chain[i]], nodes[chain[i + 1]]};
      double away = std::numeric_limits<double>::infinity();
      for (const auto& path : path_nodes_.paths) {
        for (const int node : path) {
          if (node != chain[i] && node != chain[i + 1]) away = std::min(away, distance(nodes[node], piece));
        }
      }
      if (piece.length() < too_long * std::max(away, interface_snap * options_.size)) {
        ++i;
        continue;
      }
      chain.insert(chain.begin() + static_cast<int>(i) + 1, static_cast<int>(nodes.size()));
      nodes.push_back(0.5 * (piece.from + piece.to));
    }
    return chain;
  }

  /// Two edges in one line become one where their common node is nearly, but not, a path's end.
  void join_at_path_ends(std::vector<OuterEdge>& edges, const std::vector<Point>& nodes) const {
    const auto is_needless = [&](int node) {
      bool is_near = false;
      for (const auto& path : path_nodes_.paths) {
        if (node == path.back()) return false;
        is_near = is_near || (nodes[node] - nodes[path.back()]).norm() < options_.size;
      }
      for (const auto& fracture : raw_.fractures) {
        if (node == fracture.nodes.front() || node == fracture.nodes.back()) return false;
      }
      return is_near;
    };
    for (std::size_t i = 0; i < edges.size(); ++i) {
      if (!is_needless(edges[i].nodes.back())) continue;
      for (std::size_t j = 0; j < edges.size(); ++j) {
        if (edges[j].nodes.front() != edges[i].nodes.back() || !are_in_line(edges[i], edges[j], nodes)) continue;
        edges[i].nodes.pop_back();
        edges[i].nodes.insert(edges[i].nodes.end(), edges[j].nodes.begin() + 1, edges[j].nodes.end());
        edges.erase(edges.begin() + static_cast<int>(j));
        i = static_cast<std::size_t>(-1);  // from the beginning: the indices have moved
        break;
      }
    }
  }

  std::vector<int> divide_outer_edge(const std::vector<int>& chain, std::vector<Point>& nodes) const {
    const auto wanted = [&](const Point& x) {
      double away = std::numeric_limits<double>::infinity();
      for (const auto& path : paths_) {
        for (const Segment& s : path) away = std::min(away, distance(x, s));
      }
      return options_.size + options_.growth * away;
    };
    std::vector<int> divided{chain.front()};
    for (std::size_t i = 0; i + 1 < chain.size(); ++i) {
      for (const Point& x : graded_division({nodes[chain[i]], nodes[chain[i + 1]]}, wanted)) {
        divided.push_back(static_cast<int>(nodes.size()));
        nodes.push_back(x);
      }
      divided.push_back(chain[i + 1]);
    }
    return divided;
  }

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
    raw.triangles.resize(count);
    std::vector<int> moved;
    for (int cell = 0; cell < old_count; ++cell) {
      if (refill.is_removed[cell]) continue;
      if (cell < count) {
        change.cell[cell] = cell;
      } else {
        moved.push_back(cell);
      }
    }
    // What lies beyond the end moves to the lowest free numbers; new cells take the others.
    int free = 0;
    const auto next_free = [&] {
      while (free < count && change.cell[free] != none) ++free;
      return free;
    };
    for (const int cell : moved) change.cell[next_free()] = cell;
    for (int cell = 0; cell < count; ++cell) {
      if (change.cell[cell] == none) {
        raw.triangles[cell] = refill.triangles[change.new_cells.size()];
        change.new_cells.push_back(cell);
      } else {
        raw.triangles[cell] = raw_.triangles[change.cell[cell]];
      }
    }
    measure_overlap(refill, change);
    int next_new = 0;
    for (int cell = 0; cell < count; ++cell) {
      raw.regions.push_back(mesh_.cell_region[ancestor(change, cell, next_new)]);
    }
    for (int face = 0, edge = 0; face < mesh_.face_count(); ++face) {
      if (mesh_.face_side[face] == none) continue;
      if (!refill.is_removed[mesh_.face_cells[face][0]]) raw.boundary_edges.push_back(raw_.boundary_edges[edge]);
      ++edge;
    }
    raw.boundary_edges.insert(raw.boundary_edges.end(), refill.boundary_edges.begin(), refill.boundary_edges.end());
    raw.fractures = raw_.fractures;
    for (std::size_t e = 0; e < extensions_.size(); ++e) {
      auto& chain = raw.fractures[extensions_[e].fracture].nodes;
      const auto& path = path_nodes_.paths[e];
      if (extensions_[e].at_end) {
        chain.insert(chain.end(), path.begin() + 1, path.end());
      } else {
        chain.insert(chain.begin(), path.rbegin(), path.rend() - 1);
      }
    }
    return raw;
  }

  static Corners corners(const std::vector<Point>& nodes, const std::array<int, 3>& triangle) {
    return {nodes[triangle[0]], nodes[triangle[1]], nodes[triangle[2]]};
  }

  void measure_overlap(const Refill& refill, const MeshChange& change) {
    std::vector<Corners> made, removed;
    for (const auto& triangle : refill.triangles) made.push_back(corners(refill.nodes, triangle));
    for (const int cell : change.removed_cells) removed.push_back(corners(raw_.nodes, raw_.triangles[cell]));
    holder_.assign(made.size(), none);
    std::vector<double> depth(made.size(), -std::numeric_limits<double>::infinity());
    for_each_overlap(made, removed, [&](int i, int j, double area) {
      overlaps_.emplace_back(change.new_cells[i], change.removed_cells[j], area);
      const Point center = (made[i][0] + made[i][1] + made[i][2]) / 3;
      double inside = std::numeric_limits<double>::infinity();
      for (int k = 0; k < 3; ++k) {
        const Point along = removed[j][(k + 1) % 3] - removed[j][k];
        inside = std::min(inside, cross(along, center - removed[j][k]) / along.norm());
      }
      if (inside > depth[i]) depth[i] = inside, holder_[i] = change.removed_cells[j];
    });
  }

  /// The old cell that a new cell is, or that holds its centre.
  int ancestor(const MeshChange& change, int cell, int& next_new) const {
    return change.cell[cell] != none ? change.cell[cell] : holder_[next_new++];
  }

  void map_cells(GrownMesh& grown) {
    auto& [mesh, change, angle, extension_cells] = grown;
    std::vector<Triplet> areas = std::move(overlaps_);
    int next_new = 0;
    for (int cell = 0; cell < mesh.cell_count(); ++cell) {
      mesh.cell_rank[cell] = mesh_.cell_rank[ancestor(change, cell, next_new)];
      if (change.cell[cell] != none) areas.emplace_back(cell, change.cell[cell], mesh.cell_area[cell]);
    }
    change.overlap.resize(mesh.cell_count(), mesh_.cell_count());
    change.overlap.setFromTriplets(areas.begin(), areas.end());
  }

  void map_fractures(GrownMesh& grown) const {
    auto& [mesh, change, angle, extension_cells] = grown;
    change.fracture_cell.assign(mesh.fracture_cell_count(), none);
    change.fracture_point.assign(mesh.fracture_points.size(), none);
    std::vector<int> grown_before(mesh_.fractures.size(), 0);  // at the first point
    extension_cells.resize(extensions_.size());
    for (std::size_t e = 0; e < extensions_.size(); ++e) {
      const auto& [fracture, at_end, points] = extensions_[e];
      const int count = static_cast<int>(paths_[e].size()), first = mesh.fractures[fracture].first_cell;
      if (!at_end) grown_before[fracture] = count;
      const int start = at_end ? first + mesh.fractures[fracture].cell_count - count : first + count - 1;
      for (int i = 0; i < count; ++i) extension_cells[e].push_back(at_end ? start + i : start - i);
    }
    for (std::size_t f = 0; f < mesh_.fractures.size(); ++f) {
      for (int i = 0; i < mesh_.fractures[f].cell_count; ++i) {
        const int now = mesh.fractures[f].first_cell + grown_before[f] + i, then = mesh_.fractures[f].first_cell + i;
        change.fracture_cell[now] = then;
        for (const int end : {0, 1}) {
          change.fracture_point[mesh.fracture_cells[now].points[end]] = mesh_.fracture_cells[then].points[end];
        }
      }
    }
  }

  void map_faces(const RawMesh& raw, GrownMesh& grown) const {
    auto& [mesh, change, angle, extension_cells] = grown;
    std::map<std::array<int, 2>, int> old_face;  // of the removed cells, without walls
    for (const int cell : change.removed_cells) {
      for (int k = 0; k < 3; ++k) {
        const int face = mesh_.cell_faces[cell][k];
        if (mesh_.face_fracture_cell[face] != none) continue;
        old_face[sorted(raw_.triangles[cell][k], raw_.triangles[cell][(k + 1) % 3])] = face;
      }
    }
    change.face.assign(mesh.face_count(), none);
    for (int cell = 0; cell < mesh.cell_count(); ++cell) {
      const int old = change.cell[cell];
      for (int k = 0; k < 3; ++k) {
        const int face = mesh.cell_faces[cell][k], fracture_cell = mesh.face_fracture_cell[face];
        if (old != none) {
          change.face[face] = mesh_.cell_faces[old][k];
        } else if (fracture_cell != none) {
          const int old_cell = change.fracture_cell[fracture_cell];
          if (old_cell == none) continue;
          const int wall = mesh.fracture_cells[fracture_cell].faces[0] == face ? 0 : 1;
          change.face[face] = mesh_.fracture_cells[old_cell].faces[wall];
        } else {
          const auto found = old_face.find(sorted(raw.triangles[cell][k], raw.triangles[cell][(k + 1) % 3]));
          if (found != old_face.end()) change.face[face] = found->second;
        }
      }
    }
  }

  const Mesh& mesh_;
  const CavityOptions options_;
  const std::vector<PathExtension> extensions_;
  std::vector<int> merged_;
  const RawMesh raw_;
  const PathNodes path_nodes_;
  std::vector<std::vector<Segment>> paths_;  ///< the edges along each path
  std::vector<Triplet> overlaps_;            ///< of new cells with removed ones
  std::vector<int> holder_;                  ///< per new cell, in their order: the removed cell that holds its centre
};

}  // namespace

GrownMesh extend_fractures(const Mesh& mesh, const std::vector<PathExtension>& extensions,
                           const CavityOptions& options) {
  for (const double value : {options.radius, options.size, options.growth}) {
    if (!(value > 0) || !std::isfinite(value)) {
      throw std::invalid_argument("extend_fractures: radius, size and growth must be positive numbers");
    }
  }
  return Growth(mesh, extensions, options).run();
}

}  // namespace sprekk
