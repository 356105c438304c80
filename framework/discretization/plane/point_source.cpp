#include "framework/discretization/plane/point_source.hpp"

#include <algorithm>
#include <cmath>

#include "framework/invariants.hpp"
#include "framework/mesh/plane/planar.hpp"
#include "framework/mesh/search/point_location.hpp"
#include "framework/round_off.hpp"

namespace sprekk {
namespace {

using Shares = std::vector<std::pair<int, double>>;

/// The cells at a node, in the order of their centres around it.
std::vector<int> counter_clockwise(const Mesh& mesh, int node) {
  std::vector<int> ring(mesh.node_cells[node].begin(), mesh.node_cells[node].end());
  const auto angle = [&](int cell) {
    const Point away = mesh.cell_center[cell] - mesh.nodes[node];
    return std::atan2(away[1], away[0]);
  };
  std::ranges::sort(ring, {}, angle);
  return ring;
}

/// These at a node inside of the mesh; none at nodes on sides and walls.
std::vector<int> ring_around(const Mesh& mesh, int node) {
  for (const int face : mesh.node_faces[node])
    if (mesh.face_cells[face][1] == none) return {};
  return counter_clockwise(mesh, node);
}

/// Mean value coordinates of x among the centres of the ring; none where it does not surround x.
Shares mean_value_shares(const Mesh& mesh, const std::vector<int>& ring, const Point& x) {
  const std::size_t count = ring.size();
  Shares shares;
  double sum = 0;
  std::vector<double> tangents;  // of half of the angle from each centre to the next, as seen from x
  for (std::size_t k = 0; k < count; ++k) {
    const Point one = mesh.cell_center[ring[k]] - x, next = mesh.cell_center[ring[(k + 1) % count]] - x;
    const double lengths = one.norm() * next.norm(), turn = cross(one, next), along = lengths + one.dot(next);
    if (turn < -rounding::same * lengths) return {};
    if (along <= rounding::same * lengths)  // on the line between both
      return {{ring[k], next.norm() / (one.norm() + next.norm())},
              {ring[(k + 1) % count], one.norm() / (one.norm() + next.norm())}};
    tangents.push_back(std::max(turn, 0.0) / along);
  }
  for (std::size_t k = 0; k < count; ++k) {
    const double weight = (tangents[(k + count - 1) % count] + tangents[k]) / (mesh.cell_center[ring[k]] - x).norm();
    shares.emplace_back(ring[k], weight);
    sum += weight;
  }
  if (!(sum > 0)) return {};
  for (auto& [cell, share] : shares) share /= sum;
  return shares;
}

/// Cells that follow one another around a node, counter-clockwise, so that fields go on from each to the next: through
/// the side that both share, or, from the last to the first, across the rock between both that leaves out the node.
struct Chain {
  std::vector<int> cells;
  bool is_closed = false;  ///< whether the first one follows the last one
};

bool share_a_side(const Mesh& mesh, int one, int other) {
  return std::ranges::any_of(mesh.cell_faces[one],
                             [&](int face) { return std::ranges::count(mesh.cell_faces[other], face) > 0; });
}

/// The chain in which `home` is, of the cells at a node that may share.
Chain chain_around(const Mesh& mesh, int node, int home, const std::function<bool(int cell)>& may_share) {
  std::vector<int> ring = counter_clockwise(mesh, node);
  std::erase_if(ring, [&](int cell) { return cell != home && !may_share(cell); });
  std::ranges::rotate(ring, std::ranges::find(ring, home));
  const std::size_t count = ring.size();
  const auto goes_on = [&](std::size_t k) {  // from the k-th cell to the next
    const int one = ring[k], next = ring[(k + 1) % count];
    if (share_a_side(mesh, one, next)) return true;
    const Point &from = mesh.cell_center[one], &to = mesh.cell_center[next];
    return count > 2 && cross(from - mesh.nodes[node], to - mesh.nodes[node]) < 0;
  };
  std::size_t after = 0, before = count;
  while (after < count && goes_on(after)) ++after;
  if (after == count) return {ring, count > 2};
  while (before > after + 1 && goes_on(before - 1)) --before;
  Chain chain{{ring.begin() + static_cast<std::ptrdiff_t>(before), ring.end()}};
  chain.cells.insert(chain.cells.end(), ring.begin(), ring.begin() + static_cast<std::ptrdiff_t>(after) + 1);
  return chain;
}

/// The point of a chain that is the nearest to x, and the shares of the two cells between which it lies.
PointSource nearest_on(const Mesh& mesh, const Chain& chain, const Point& x) {
  PointSource nearest{mesh.cell_center[chain.cells[0]], {{chain.cells[0], 1.0}}};
  for (std::size_t k = 0; k + (chain.is_closed ? 0 : 1) < chain.cells.size(); ++k) {
    const int one = chain.cells[k], next = chain.cells[(k + 1) % chain.cells.size()];
    const Point from = mesh.cell_center[one], way = mesh.cell_center[next] - from;
    const double part = std::clamp((x - from).dot(way) / way.squaredNorm(), 0.0, 1.0);
    const Point at = from + part * way;
    if ((at - x).norm() < (nearest.at - x).norm()) nearest = {at, {{one, 1 - part}, {next, part}}};
  }
  return nearest;
}

/// Where no cells around an inner node surround x: beside sides, walls, and cells that may not share.
PointSource beside_the_last_centres(const Mesh& mesh, const Point& x, int home,
                                    const std::function<bool(int cell)>& may_share) {
  PointSource nearest{mesh.cell_center[home], {{home, 1.0}}};
  for (const int node : mesh.cell_nodes[home]) {
    const Chain chain = chain_around(mesh, node, home, may_share);
    if (chain.is_closed)
      if (Shares shares = mean_value_shares(mesh, chain.cells, x); !shares.empty()) return {x, std::move(shares)};
    if (PointSource found = nearest_on(mesh, chain, x); (found.at - x).norm() < (nearest.at - x).norm())
      nearest = std::move(found);
  }
  return nearest;
}

}  // namespace

PointSource point_source(const Mesh& mesh, const Point& x, const std::function<bool(int cell)>& may_share) {
  SPREKK_EXPECT(is_finite(x));
  const int home = PointLocation(mesh).cell_at(x);
  if (home == none) return {x, {}};
  if ((mesh.cell_center[home] - x).norm() <= rounding::same * std::sqrt(mesh.cell_measure[home]))
    return {x, {{home, 1.0}}};
  for (const int node : mesh.cell_nodes[home]) {
    const std::vector<int> ring = ring_around(mesh, node);
    const bool may = std::ranges::all_of(ring, [&](int cell) { return cell == home || may_share(cell); });
    if (ring.size() < 3 || !may) continue;
    if (Shares shares = mean_value_shares(mesh, ring, x); !shares.empty()) return {x, std::move(shares)};
  }
  return beside_the_last_centres(mesh, x, home, may_share);
}

}  // namespace sprekk
