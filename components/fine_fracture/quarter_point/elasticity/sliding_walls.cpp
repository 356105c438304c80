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
  std::map<int, int> places;
  for (const FineMesh::WallEdge& edge : mesh.wall_edges) {
    const auto law = sliding_of(mesh, edge, loads);
    if (!law) continue;
    Edge& sliding = edges_.emplace_back(Edge{&edge, {}, *law});
    for (int k = 0; k < 2; ++k)
      sliding.places[k] = places.emplace(edge.nodes[0][k], static_cast<int>(places.size())).first->second;
  }
  count_ = static_cast<int>(places.size());
}

Vector SlidingContact::gaps(const Vector& displacement, bool with_opening) const {
  Vector gaps = Vector::Zero(count_);
  for (const Edge& sliding : edges_)
    for (const LinePoint& place : line_rule(edge_points)) {
      const auto& [plus, minus] = sliding.edge->nodes;
      const EdgePoint p = edge_point(mesh_, plus, place.t);
      Point jump = Point::Zero();
      for (int k = 0; k < 3; ++k)
        jump += p.value[k] * (displacement.segment<2>(2 * minus[k]) - displacement.segment<2>(2 * plus[k]));
      const double gap = sliding.law.gap.dot(jump) - (with_opening ? sliding.law.opening : 0);
      for (int end = 0; end < 2; ++end)
        gaps[sliding.places[end]] += hat(end, place.t) * place.weight * p.jacobian * gap;
    }
  return gaps;
}

Vector SlidingContact::unit_force(int at) const {
  Vector forces = Vector::Zero(2 * mesh_.node_count());
  for (const Edge& sliding : edges_)
    for (int end = 0; end < 2; ++end) {
      if (sliding.places[end] != at) continue;
      for (const LinePoint& place : line_rule(edge_points)) {
        const EdgePoint p = edge_point(mesh_, sliding.edge->nodes[0], place.t);
        const Point force = hat(end, place.t) * place.weight * p.jacobian * sliding.law.traction;
        for (int k = 0; k < 3; ++k)
          for (int side = 0; side < 2; ++side)
            forces.segment<2>(2 * sliding.edge->nodes[side][k]) += (side == 0 ? 1 : -1) * p.value[k] * force;
      }
    }
  return forces;
}

Vector SlidingContact::displacement(
    const Vector& without, const std::function<Eigen::MatrixXd(const Eigen::MatrixXd& forces)>& responses) const {
  const Vector gaps_without = gaps(without, true);
  if (gaps_without.minCoeff() >= 0) return Vector::Zero(without.size());  // all open
  Eigen::MatrixXd units(without.size(), count_);
  for (int j = 0; j < count_; ++j) units.col(j) = unit_force(j);
  const Eigen::MatrixXd by_units = responses(units);
  Eigen::MatrixXd compliance(count_, count_);
  for (int j = 0; j < count_; ++j) compliance.col(j) = gaps(by_units.col(j), false);
  return by_units * contact_forces(compliance, gaps_without);
}

}  // namespace sprekk::fine_fracture
