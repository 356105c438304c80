#include "framework/remeshing/refill_cavity.hpp"

#include <algorithm>
#include <cmath>
#include <map>
#include <numbers>
#include <stdexcept>
#include <string>

#include "framework/mesh/plane/original_end.hpp"
#include "framework/meshing/plane/graded_division.hpp"
#include "framework/remeshing/cavity.hpp"
#include "framework/remeshing/fill_cavity.hpp"
#include "framework/remeshing/rounded_filling.hpp"
#include "framework/round_off.hpp"

namespace sprekk {
namespace {

using Place = CavityOutline::Edge::Place;

/// Smaller edges and larger cavities are tried while the smallest angle is below this, rad.
constexpr double wanted_angle = 25 * std::numbers::pi / 180;
struct Attempt {
  double radius_factor, size_factor;
};
/// In the order of their cost.
constexpr Attempt attempts[] = {{1, 1}, {1, 0.75}, {1.25, 1}, {1.25, 0.75}, {1.6, 1}, {2, 1}};
/// The search ends after this many attempts in a row without an improvement, since some angles between fixed lines are
/// small.
constexpr int most_vain_attempts = 2;
/// An edge of an interface is divided when it is so many times longer than the gap between it and a path.
constexpr double too_long = 1.5;

bool is_good(const Refill& refill) { return refill.single_corners == 0 && refill.smallest_angle >= wanted_angle; }

bool is_better(const Refill& one, const Refill& other) {
  if (one.single_corners != other.single_corners) return one.single_corners < other.single_corners;
  return one.smallest_angle > other.smallest_angle;
}

class Refilling {
 public:
  Refilling(const Mesh& mesh, const RawMesh& raw, const std::vector<int>& merged, const PathNodes& path_nodes,
            const std::vector<std::vector<Segment>>& paths, const std::vector<std::vector<Segment>>& scars,
            const CavityOptions& options)
      : mesh_(mesh),
        raw_(raw),
        merged_(merged),
        path_nodes_(path_nodes),
        paths_(paths),
        centre_lines_(paths),
        options_(options) {
    for (const auto& scar : scars)
      if (!scar.empty()) centre_lines_.push_back(scar);
  }

  Refill best() const {
    Refill best;
    bool has_one = false;
    std::string failure;
    int in_vain = 0;
    for (const Attempt& attempt : attempts) {
      try {
        Refill next = refill(attempt);
        in_vain = !has_one || is_better(next, best) ? 0 : in_vain + 1;
        if (in_vain == 0) best = std::move(next);
        has_one = true;
        if (is_good(best) || in_vain == most_vain_attempts) break;
      } catch (const std::runtime_error& error) {
        failure = error.what();
      }
    }
    if (!has_one) throw std::runtime_error("fractures cannot be extended: " + failure);
    return best;
  }

 private:
  Refill refill(const Attempt& attempt) const {
    Refill refill;
    refill.nodes = path_nodes_.nodes;
    refill.is_removed =
        choose_cavity(mesh_, merged_, centre_lines_,
                      std::vector<double>(centre_lines_.size(), attempt.radius_factor * options_.radius));
    const std::vector<int> part = connected_parts(mesh_, refill.is_removed);
    std::vector<std::vector<int>> cells;
    for (int cell = 0; cell < mesh_.cell_count(); ++cell) {
      if (part[cell] == none) continue;
      if (part[cell] == static_cast<int>(cells.size())) cells.emplace_back();
      cells[part[cell]].push_back(cell);
    }
    std::vector<int> part_of_path;
    for (const auto& path : paths_) part_of_path.push_back(part_met(path, cells));
    for (std::size_t p = 0; p < cells.size(); ++p)
      fill(cells[p], static_cast<int>(p), part_of_path, attempt.size_factor, refill);
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
      const auto [entry, is_new] = edge_of_.try_emplace(std::minmax(from, to), outline_.edges.size());
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
    std::map<std::pair<int, int>, std::size_t> edge_of_;
  };

  /// Of the outer boundary, counter-clockwise.
  struct OuterEdge {
    std::vector<int> nodes;  ///< both ends and the new nodes between them
    int side, region;
  };

  static bool are_in_line(const OuterEdge& a, const OuterEdge& b, const std::vector<Point>& nodes) {
    const Point u = nodes[a.nodes.back()] - nodes[a.nodes.front()], v = nodes[b.nodes.back()] - nodes[b.nodes.front()];
    return a.side == b.side && a.region == b.region &&
           std::abs(cross(u, v)) <= rounding::of_terms * u.norm() * v.norm();
  }

  void fill(const std::vector<int>& cells, int part, const std::vector<int>& part_of_path, double size_factor,
            Refill& refill) const {
    Outline outline(refill.nodes);
    std::vector<OuterEdge> outer_edges;
    for (std::size_t p = 0; p < part_of_path.size(); ++p) {
      if (part_of_path[p] != part) continue;
      const auto& path = path_nodes_.paths[p];
      for (std::size_t i = 0; i + 1 < path.size(); ++i) outline.add(path[i], path[i + 1], Place::inside, true);
    }
    for (const int cell : cells) {
      const Ring& corners = mesh_.cell_nodes[cell];
      for (int k = 0; k < corners.size(); ++k) {
        const int face = mesh_.cell_faces[cell][k], next = cell_across(mesh_, cell, k);
        const int a = merged_[corners[k]], b = merged_[corners.after(k)];
        const bool is_fracture = mesh_.face_fracture_cell[face] != none;
        if (next == none) {
          outer_edges.push_back(
              {with_added_nodes(face, a, b, refill.nodes), mesh_.face_side[face], mesh_.cell_region[cell]});
        } else if (!refill.is_removed[next]) {
          outline.add(a, b, Place::rim, is_fracture);
        } else if (is_fracture) {
          outline.add(a, b, Place::inside, true);
        } else if (mesh_.cell_region[cell] != mesh_.cell_region[next]) {
          if (cell > next) continue;  // each edge is divided only once
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
        refill.boundary_faces.push_back({{nodes[i], nodes[i + 1]}, edge.side});
      }
    }
    const Triangulation filling = filled(outline.get(), size_factor, part, part_of_path);
    refill.smallest_angle = std::min(refill.smallest_angle, smallest_angle(filling));
    refill.single_corners += single_corner_count(filling);
    std::vector<int> node_of = outline.nodes();
    for (std::size_t i = node_of.size(); i < filling.points.size(); ++i) {
      node_of.push_back(static_cast<int>(refill.nodes.size()));
      refill.nodes.push_back(filling.points[i]);
    }
    for (const auto& [a, b, c] : filling.triangles) refill.triangles.push_back({node_of[a], node_of[b], node_of[c]});
  }

  Triangulation filled(const CavityOutline& outline, double size_factor, int part,
                       const std::vector<int>& part_of_path) const {
    if (options_.rounds)
      if (auto filling = fill_rounded_cavity(outline, size_factor, options_.growth, anchor(part, part_of_path)))
        return std::move(*filling);
    return fill_cavity(outline, size_factor, options_.growth);
  }

  /// The mean of the original ends, before any growth, of the fractures that grow in a cavity.
  Point anchor(int part, const std::vector<int>& part_of_path) const {
    Point sum = Point::Zero();
    int count = 0;
    for (std::size_t p = 0; p < part_of_path.size(); ++p) {
      if (part_of_path[p] != part) continue;
      for (int f = 0; f < static_cast<int>(raw_.fractures.size()); ++f)
        for (const bool at_end : {false, true}) {
          const std::vector<int>& chain = raw_.fractures[f].nodes;
          if ((at_end ? chain.back() : chain.front()) != path_nodes_.paths[p].front()) continue;
          sum += original_end(mesh_, f, at_end);
          ++count;
        }
    }
    return count == 0 ? sum : Point(sum / count);
  }

  /// The node a, the new nodes on the face in their order, and b.
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

  /// Divides an interface between regions so that its edges are no longer than a small gap between it and a path.
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
      if (is_edge_of_path(chain[i], chain[i + 1]) ||
          piece.length() < too_long * std::max(away, interface_snap * options_.size)) {
        ++i;
        continue;
      }
      chain.insert(chain.begin() + static_cast<int>(i) + 1, static_cast<int>(nodes.size()));
      nodes.push_back(0.5 * (piece.from + piece.to));
    }
    return chain;
  }

  /// Whether an edge of an interface is an edge of a path: paths may run along interfaces.
  bool is_edge_of_path(int a, int b) const {
    return std::any_of(path_nodes_.paths.begin(), path_nodes_.paths.end(), [&](const std::vector<int>& path) {
      for (std::size_t i = 0; i + 1 < path.size(); ++i)
        if (std::minmax(path[i], path[i + 1]) == std::minmax(a, b)) return true;
      return false;
    });
  }

  /// Joins two edges on one line where their common node is very near to the end of a path, but not that end.
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
      double size = options_.size + options_.growth * away;
      for (const auto& narrow : path_nodes_.narrow)
        size = std::min(size, narrow.size + options_.growth * (x - narrow.position).norm());
      return size;
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

  const Mesh& mesh_;
  const RawMesh& raw_;
  const std::vector<int>& merged_;
  const PathNodes& path_nodes_;
  const std::vector<std::vector<Segment>>& paths_;  ///< the edges along each path
  std::vector<std::vector<Segment>> centre_lines_;  ///< paths and scars
  const CavityOptions& options_;
};

}  // namespace

Refill refill_cavities(const Mesh& mesh, const RawMesh& raw, const std::vector<int>& merged,
                       const PathNodes& path_nodes, const std::vector<std::vector<Segment>>& segments,
                       const std::vector<std::vector<Segment>>& scars, const CavityOptions& options) {
  return Refilling(mesh, raw, merged, path_nodes, segments, scars, options).best();
}

}  // namespace sprekk
