#include "framework/discretization/point_source.hpp"

#include <algorithm>
#include <cmath>

#include "framework/discretization/linear_fit.hpp"
#include "framework/invariants.hpp"
#include "framework/mesh/planar.hpp"
#include "framework/mesh/point_location.hpp"

namespace sprekk {
namespace {

constexpr double same_place = 1e-9;  // of the size of a cell

using Shares = std::vector<std::pair<int, double>>;

/// The cells at a node inside of the mesh, counter-clockwise; none at nodes on sides and walls.
std::vector<int> ring_around(const Mesh& mesh, int node) {
  for (const int face : mesh.node_faces[node])
    if (mesh.face_cells[face][1] == none) return {};
  std::vector<int> ring(mesh.node_cells[node].begin(), mesh.node_cells[node].end());
  const auto angle = [&](int cell) {
    const Point away = mesh.cell_center[cell] - mesh.nodes[node];
    return std::atan2(away[1], away[0]);
  };
  std::ranges::sort(ring, {}, angle);
  return ring;
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
    if (turn < -same_place * lengths) return {};
    if (along <= same_place * lengths)  // on the line between both
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

}  // namespace

PointSource point_source(const Mesh& mesh, const Point& x, const std::function<bool(int cell)>& may_share) {
  SPREKK_EXPECT(is_finite(x));
  const int home = PointLocation(mesh).cell_at(x);
  if (home == none) return {x, {}};
  if ((mesh.cell_center[home] - x).norm() <= same_place * std::sqrt(mesh.cell_measure[home])) return {x, {{home, 1.0}}};
  for (const int node : mesh.cell_nodes[home]) {
    const std::vector<int> ring = ring_around(mesh, node);
    const bool may = std::ranges::all_of(ring, [&](int cell) { return cell == home || may_share(cell); });
    if (ring.size() < 3 || !may) continue;
    if (Shares shares = mean_value_shares(mesh, ring, x); !shares.empty()) return {x, std::move(shares)};
  }
  return {x, linear_fit(mesh, x, [&](int, int other) { return may_share(other); })};
}

}  // namespace sprekk
