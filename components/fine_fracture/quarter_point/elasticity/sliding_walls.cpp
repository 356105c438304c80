#include "components/fine_fracture/quarter_point/elasticity/sliding_walls.hpp"

#include <map>

#include "components/fine_fracture/fine_level/contact_forces.hpp"
#include "components/fine_fracture/fine_level/quadrature.hpp"
#include "components/fine_fracture/quarter_point/elasticity/shapes.hpp"
#include "components/fine_fracture/quarter_point/elasticity/wall_place.hpp"
#include "framework/mesh/mesh.hpp"

namespace sprekk::fine_fracture {
namespace {

constexpr int edge_points = 3;  ///< exact for the product of a hat function and a quadratic displacement

double hat(int end, double t) { return end == 0 ? 1 - t : t; }

}  // namespace

std::optional<TipSurroundings::Sliding> sliding_of(const FineMesh& mesh, const FineMesh::WallEdge& edge,
                                                   const FineLoads& loads) {
  if (!loads.sliding || edge.tip != none || edge.walls != CrackPath::Walls::traction) return std::nullopt;
  const WallPlace middle = wall_place(mesh, edge, edge_point(mesh, edge.nodes[0], 0.5).x);
  return loads.sliding(edge.crack, middle.segment, middle.s);
}

SlidingContact::SlidingContact(const FineMesh& mesh, const FineLoads& loads) : mesh_(mesh) {
  std::map<int, int> places, nodes;
  for (const FineMesh::WallEdge& edge : mesh.wall_edges) {
    const auto law = sliding_of(mesh, edge, loads);
    if (!law) continue;
    Edge& sliding = edges_.emplace_back(Edge{&edge, {}, {}, *law});
    for (int k = 0; k < 2; ++k)
      sliding.places[k] = places.emplace(edge.nodes[0][k], static_cast<int>(places.size())).first->second;
    for (int side = 0; side < 2; ++side)
      for (int k = 0; k < 3; ++k) {
        const int node = edge.nodes[side][k];
        const auto [known, is_new] = nodes.emplace(node, static_cast<int>(components_.size()));
        sliding.nodes[side][k] = known->second;
        if (is_new) components_.insert(components_.end(), {2 * node, 2 * node + 1});
      }
  }
  count_ = static_cast<int>(places.size());
}

Vector SlidingContact::gaps(const Vector& displacement, bool with_opening) const {
  Vector gaps = Vector::Zero(count_);
  for (const Edge& sliding : edges_)
    for (const LinePoint& place : line_rule(edge_points)) {
      const auto& [plus, minus] = sliding.nodes;
      const EdgePoint p = edge_point(mesh_, sliding.edge->nodes[0], place.t);
      Point jump = Point::Zero();
      for (int k = 0; k < 3; ++k)
        jump += p.value[k] * (displacement.segment<2>(minus[k]) - displacement.segment<2>(plus[k]));
      const double gap = sliding.law.gap.dot(jump) - (with_opening ? sliding.law.opening : 0);
      for (int end = 0; end < 2; ++end)
        gaps[sliding.places[end]] += hat(end, place.t) * place.weight * p.jacobian * gap;
    }
  return gaps;
}

Eigen::MatrixXd SlidingContact::unit_forces() const {
  Eigen::MatrixXd forces = Eigen::MatrixXd::Zero(static_cast<Eigen::Index>(components_.size()), count_);
  for (const Edge& sliding : edges_)
    for (const LinePoint& place : line_rule(edge_points)) {
      const EdgePoint p = edge_point(mesh_, sliding.edge->nodes[0], place.t);
      for (int end = 0; end < 2; ++end) {
        const Point force = hat(end, place.t) * place.weight * p.jacobian * sliding.law.traction;
        for (int k = 0; k < 3; ++k)
          for (int side = 0; side < 2; ++side)
            forces.block<2, 1>(sliding.nodes[side][k], sliding.places[end]) +=
                (side == 0 ? 1 : -1) * p.value[k] * force;
      }
    }
  return forces;
}

std::optional<Vector> SlidingContact::forces(
    const Vector& without, const std::function<Eigen::MatrixXd(const Eigen::MatrixXd& forces)>& responses) const {
  const Vector open = gaps(without(components_), true);
  if (open.minCoeff() >= 0) return std::nullopt;
  const Eigen::MatrixXd units = unit_forces(), by_units = responses(units);
  Eigen::MatrixXd compliance(count_, count_);
  for (int j = 0; j < count_; ++j) compliance.col(j) = gaps(by_units.col(j), false);
  return units * contact_forces(compliance, open);
}

}  // namespace sprekk::fine_fracture
