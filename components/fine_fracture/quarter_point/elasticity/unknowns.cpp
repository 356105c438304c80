#include "components/fine_fracture/quarter_point/elasticity/unknowns.hpp"

#include <numeric>
#include <utility>

#include "components/fine_fracture/quarter_point/elasticity/wall_place.hpp"
#include "framework/invariants.hpp"
#include "framework/mesh/mesh.hpp"

namespace sprekk::fine_fracture {

namespace {

/// Disjoint sets of nodes (union-find).
class Parts {
 public:
  explicit Parts(int nodes) : part_(nodes) { std::iota(part_.begin(), part_.end(), 0); }

  int of(int n) {
    SPREKK_EXPECT(is_index(n, static_cast<long>(part_.size())), n, part_.size());
    while (part_[n] != n) n = part_[n] = part_[part_[n]];
    return n;
  }
  void join(int n, int other) { part_[of(n)] = of(other); }

 private:
  std::vector<int> part_;
};

}  // namespace

Unknowns::Unknowns(const FineGeometry& geometry, const FineMesh& mesh)
    : is_prescribed_(mesh.node_count(), false), is_slave_(mesh.node_count(), false) {
  prescribe_sides(geometry, mesh);
  tie_walls(mesh);
  pin_floating_parts(mesh);
  number(mesh);
}

void Unknowns::prescribe_sides(const FineGeometry& geometry, const FineMesh& mesh) {
  for (const FineMesh::OutlineEdge& edge : mesh.outline_edges) {
    if (geometry.side(edge.edge) != FineGeometry::Side::displacement) continue;
    const auto& corners = mesh.elements[edge.element].nodes;
    const Point center = (mesh.nodes[corners[0]] + mesh.nodes[corners[1]] + mesh.nodes[corners[2]]) / 3;
    for (const int node : edge.nodes) {
      if (is_prescribed_[node]) continue;
      is_prescribed_[node] = true;
      constexpr double slightly = 0.1;  // of the way to the element's centre: clearly inside
      prescribed_.push_back({node, mesh.nodes[node] + slightly * (center - mesh.nodes[node])});
    }
  }
}

void Unknowns::tie_walls(const FineMesh& mesh) {
  // The copies of a node form a tree: one for a pair of walls, more where cracks meet. The jump that would close a ring
  // around a junction follows from the others.
  struct Branch {
    int plus, minus, wall_edge;
  };
  std::vector<Branch> branches;
  std::vector<std::vector<int>> branches_at(mesh.node_count());
  Parts trees(mesh.node_count());
  for (std::size_t e = 0; e < mesh.wall_edges.size(); ++e) {
    const FineMesh::WallEdge& edge = mesh.wall_edges[e];
    if (edge.walls != CrackPath::Walls::jump) continue;
    for (int k = 0; k < 3; ++k) {
      const int plus = edge.nodes[0][k], minus = edge.nodes[1][k];
      SPREKK_ASSERT((mesh.nodes[plus] - mesh.nodes[minus]).norm() <= nearly_equal * (1 + mesh.nodes[plus].norm()), plus,
                    minus);
      if (trees.of(plus) == trees.of(minus) || (is_prescribed_[plus] && is_prescribed_[minus])) continue;
      trees.join(plus, minus);
      for (const int node : {plus, minus}) branches_at[node].push_back(static_cast<int>(branches.size()));
      branches.push_back({plus, minus, static_cast<int>(e)});
    }
  }
  // From the root of each tree outwards, so that masters come before their slaves. A junction lies inside of the
  // outline, and so no tree has two prescribed nodes.
  std::vector<char> is_done(branches.size(), false);
  for (const Branch& first : branches) {
    std::vector<int> reached{is_prescribed_[first.minus] ? first.minus : first.plus};
    for (std::size_t i = 0; i < reached.size(); ++i) {
      for (const int b : branches_at[reached[i]]) {
        if (std::exchange(is_done[b], true)) continue;
        const auto [plus, minus, wall_edge] = branches[b];
        const bool follows_plus = reached[i] == plus;
        SPREKK_ASSERT(follows_plus || reached[i] == minus, reached[i], plus, minus);
        reached.push_back(follows_plus ? minus : plus);
        is_slave_[reached.back()] = true;
        SPREKK_ASSERT(!is_prescribed_[reached.back()], reached.back());
        ties_.push_back({reached.back(), reached[i], follows_plus ? 1.0 : -1.0, wall_edge});
      }
    }
  }
}

/// Pins parts of the rock without prescribed displacements, which removes their rigid-body motions.
void Unknowns::pin_floating_parts(const FineMesh& mesh) {
  Parts parts(mesh.node_count());
  const auto root = [&parts](int n) { return parts.of(n); };
  for (const FineMesh::Element& element : mesh.elements) {
    for (int k = 1; k < 6; ++k) parts.join(element.nodes[k], element.nodes[0]);
  }
  for (const Tie& tie : ties_) parts.join(tie.slave, tie.master);
  std::vector<char> is_held(mesh.node_count(), false);
  for (const Prescribed& p : prescribed_) is_held[root(p.node)] = true;
  for (int first = 0; first < mesh.node_count(); ++first) {
    if (is_held[root(first)] || is_slave_[first]) continue;
    is_held[root(first)] = true;
    int farthest = first;
    for (int n = first; n < mesh.node_count(); ++n) {
      if (root(n) != root(first) || is_slave_[n]) continue;
      if ((mesh.nodes[n] - mesh.nodes[first]).norm() > (mesh.nodes[farthest] - mesh.nodes[first]).norm()) farthest = n;
    }
    const Point arm = (mesh.nodes[farthest] - mesh.nodes[first]).cwiseAbs();
    const int across = arm.x() > arm.y() ? 1 : 0;
    pinned_.insert(pinned_.end(), {2 * first, 2 * first + 1, 2 * farthest + across});
  }
}

void Unknowns::number(const FineMesh& mesh) {
  unknown_.assign(2 * mesh.node_count(), 0);
  for (const Prescribed& p : prescribed_) unknown_[2 * p.node] = unknown_[2 * p.node + 1] = none;
  for (const int component : pinned_) unknown_[component] = none;
  for (int n = 0; n < mesh.node_count(); ++n) {
    if (is_slave_[n]) continue;
    for (int component = 2 * n; component < 2 * n + 2; ++component) {
      if (unknown_[component] != none) unknown_[component] = count_++;
    }
  }
  for (const Tie& tie : ties_) {
    SPREKK_ASSERT(tie.slave != tie.master && is_slave_[tie.slave], tie.slave, tie.master);
    for (int d = 0; d < 2; ++d) unknown_[2 * tie.slave + d] = unknown_[2 * tie.master + d];
  }
}

Vector Unknowns::prescribed_values(const FineMesh& mesh, const FineLoads& loads) const {
  Vector g = Vector::Zero(2 * mesh.node_count());
  SPREKK_EXPECT(static_cast<int>(unknown_.size()) == 2 * mesh.node_count(), unknown_.size(), mesh.node_count());
  if (loads.boundary_displacement) {
    for (const Prescribed& p : prescribed_) {
      g.segment<2>(2 * p.node) = loads.boundary_displacement(mesh.nodes[p.node], p.inside);
    }
  }
  for (const Tie& tie : ties_) {
    g.segment<2>(2 * tie.slave) = g.segment<2>(2 * tie.master);
    if (!loads.wall_jump) continue;
    const FineMesh::WallEdge& edge = mesh.wall_edges[tie.wall_edge];
    const WallPlace place = wall_place(mesh, edge, mesh.nodes[tie.slave]);
    g.segment<2>(2 * tie.slave) += tie.sign * loads.wall_jump(edge.crack, place.segment, place.s);
  }
  return g;
}

}  // namespace sprekk::fine_fracture
