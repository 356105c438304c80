#include "components/fine_fracture/quarter_point/elasticity/interaction_integral.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <optional>

#include "components/fine_fracture/quarter_point/elasticity/auxiliary_field.hpp"
#include "components/fine_fracture/quarter_point/elasticity/cut_elements.hpp"
#include "components/fine_fracture/quarter_point/elasticity/shapes.hpp"
#include "components/fine_fracture/quarter_point/elasticity/wall_place.hpp"
#include "framework/invariants.hpp"
#include "framework/mesh/mesh.hpp"

namespace sprekk::fine_fracture {
namespace {

constexpr std::array auxiliary_fields = {Auxiliary::opening, Auxiliary::sliding, Auxiliary::force};

/// du_i/dx_j.
Tensor gradient(const FineMesh::Element& element, const ShapePoint& p, const Vector& displacement) {
  Tensor g = Tensor::Zero();
  for (int k = 0; k < 6; ++k) g += displacement.segment<2>(2 * element.nodes[k]) * p.gradient.row(k);
  return g;
}

/// Local coordinates of the element at a place on one of its edges.
std::array<double, 2> place_on_edge(const FineMesh::Element& element, const EdgeNodes& nodes, double t) {
  std::array<double, 3> corner_share{};
  for (int k = 0; k < 3; ++k) {
    if (element.nodes[k] == nodes[0]) corner_share[k] = 1 - t;
    if (element.nodes[k] == nodes[1]) corner_share[k] = t;
  }
  return {corner_share[1], corner_share[2]};
}

}  // namespace

struct InteractionIntegrals::State {
  const FineLoads& loads;
  const Eigen::Ref<const Eigen::Matrix3Xd>& offsets;
  const Vector& displacement;
  std::array<Point, 2> fitted{Point(0, 0), Point(0, 0)};  ///< traction at the tip, and its change with r

  Tensor offset(int column) const { return offsets.cols() > 0 ? symmetric(offsets.col(column)) : Tensor::Zero(); }
};

InteractionIntegrals::InteractionIntegrals(const FineMesh& mesh, const FineRock& rock, const FineMesh::Tip& tip,
                                           const std::array<double, 2>& radii)
    : mesh_(mesh),
      rock_by_place_(rock),
      rock_(rock.at(tip.room.position)),
      tip_(tip),
      radii_(radii),
      offset_places_{tip.room.position},
      of_displacement_(Rows<Eigen::Dynamic>::Zero(sums, 2 * mesh.node_count())) {
  const Point& x1 = tip.room.direction;
  frame_ << x1.x(), -x1.y(), x1.y(), x1.x();
  SPREKK_EXPECT(is_unit(x1), x1.norm());
  SPREKK_EXPECT(radii[0] > tip.room.radius && radii[1] > tip.room.radius, radii[0], radii[1], tip.room.radius);
  SPREKK_EXPECT(radii[0] >= radii[1], radii[0], radii[1]);
  for (const FineMesh::WallEdge& edge : mesh.wall_edges)
    if (edge.tip != none && &mesh.tips[edge.tip] == &tip) own_wall_ = &edge;
  for (const FineMesh::Element& element : mesh.elements) add_element(element);
  for (const FineMesh::WallEdge& edge : mesh.wall_edges)
    if (edge.crack == tip.room.crack) add_wall(edge);
  if (own_wall_ != nullptr && own_wall_->walls == CrackPath::Walls::jump) add_places_of_fit();
}

/// Domain 0 is the larger one: where its weight is 0, that of the other is 0, too.
double InteractionIntegrals::weight(int node, int domain) const {
  SPREKK_EXPECT(is_index(node, mesh_.node_count()) && is_index(domain, domains), node, domain);
  const double r = (mesh_.nodes[node] - tip_.room.position).norm(), inner = tip_.room.radius;
  return std::clamp((radii_[domain] - r) / (radii_[domain] - inner), 0.0, 1.0);
}

void InteractionIntegrals::add_element(const FineMesh::Element& element) {
  std::array<std::array<double, 3>, domains> q;
  for (int k = 0; k < 3; ++k) q[0][k] = weight(element.nodes[k], 0);
  if (q[0] == std::array<double, 3>{}) return;
  const bool is_rosette = element.tip != none;     // the weight is constant in a rosette
  if (is_rosette && !is_own(element.tip)) return;  // the weight is 0 up to rounding
  std::array<Point, domains> dq;
  for (int d = 0; d < domains; ++d) {
    for (int k = 0; k < 3; ++k) q[d][k] = weight(element.nodes[k], d);
    dq[d] = is_rosette ? Point(0, 0) : weight_gradient(element, q[d]);
  }
  constexpr int along_rays = 4, across = 5, degree = 6;
  std::optional<Elasticity> of_rosette;
  if (is_rosette) of_rosette = rosette_stiffness(mesh_, element, rock_by_place_);
  for (const TrianglePoint& place :
       is_rosette ? polar_rule(along_rays, across) : element_rule(mesh_, element, rock_by_place_, degree)) {
    const ShapePoint p = shape_point(mesh_, element, place.xi, place.eta);
    const Point x = frame_.transpose() * (p.x - tip_.room.position);
    const Eigen::Matrix<double, 6, 2> along_frame = p.gradient * frame_;
    const double factor = place.weight * p.jacobian;
    const std::array<AuxiliaryPoint, fields> auxiliary = auxiliary_points(rock_, x);
    const Elasticity here = is_rosette ? *of_rosette : rock_by_place_.at(p.x),
                     more{here.lambda - rock_.lambda, here.shear - rock_.shear};
    Rows<3> of_offset;
    Rows<2> of_body_force;
    for (int d = 0; d < domains; ++d) {
      const double q_here = is_rosette ? 1 : q[d][0] + place.xi * (q[d][1] - q[d][0]) + place.eta * (q[d][2] - q[d][0]);
      for (int f = 0; f < fields; ++f) {
        const AuxiliaryPoint& a = auxiliary[f];
        const int row = d * fields + f;
        // The coefficients of the offset and of the gradient g in the integrand, in the frame of the tip. Stress
        // without the offset is C g, and sa : eps = sa : g.
        const Tensor work = a.displacement_along * dq[d].transpose();
        const Tensor by_offset =
            frame_ * (factor * (0.5 * (work + work.transpose()) + q_here * a.strain_along)) * frame_.transpose();
        of_offset.row(row) << by_offset(0, 0), by_offset(1, 1), by_offset(0, 1) + by_offset(1, 0);
        of_body_force.row(row) = -factor * q_here * (frame_ * a.displacement_along).transpose();
        if (!(here == rock_)) {
          const Tensor by_stiffness = more.stress(by_offset);
          for (int k = 0; k < 6; ++k)
            of_displacement_.row(row).segment<2>(2 * element.nodes[k]) += p.gradient.row(k) * by_stiffness;
        }
        if (is_rosette) continue;
        Tensor by_gradient = rock_.stress(work) - dq[d].x() * a.stress;
        by_gradient.col(0) += a.stress * dq[d];
        by_gradient *= factor;
        of_gradient_.row(row) += Eigen::Map<const Eigen::RowVector4d>(by_gradient.data());
        const Eigen::Matrix<double, 2, 6> by_node = frame_ * by_gradient * along_frame.transpose();
        for (int k = 0; k < 6; ++k)
          of_displacement_.row(row).segment<2>(2 * element.nodes[k]) += by_node.col(k).transpose();
      }
    }
    offset_places_.push_back(p.x);
    of_offset_.push_back(of_offset);
    of_body_force_.push_back(of_body_force);
  }
}

Point InteractionIntegrals::weight_gradient(const FineMesh::Element& element, const std::array<double, 3>& q) const {
  const Point a = mesh_.nodes[element.nodes[1]] - mesh_.nodes[element.nodes[0]];
  const Point b = mesh_.nodes[element.nodes[2]] - mesh_.nodes[element.nodes[0]];
  const double determinant = a.x() * b.y() - a.y() * b.x();
  SPREKK_ASSERT(determinant > 0, determinant);
  const double da = (q[1] - q[0]) / determinant, db = (q[2] - q[0]) / determinant;
  return frame_.transpose() * Point(da * b.y() - db * a.y(), db * a.x() - da * b.x());
}

InteractionIntegrals::WallPoint InteractionIntegrals::wall_point(const FineMesh::WallEdge& edge,
                                                                 const LinePoint& place) {
  const EdgePoint p = edge_point(mesh_, edge.nodes[0], place.t);
  WallPoint point{&edge, p.x, frame_.transpose() * edge.normal, place.t, place.weight * p.jacobian, none};
  if (edge.walls == CrackPath::Walls::jump && edge.tip == none) {
    point.offset = static_cast<int>(offset_places_.size());
    offset_places_.push_back(p.x);
  }
  return point;
}

void InteractionIntegrals::add_wall(const FineMesh::WallEdge& edge) {
  std::array<double, domains> q_from, q_to;
  for (int d = 0; d < domains; ++d) {
    q_from[d] = weight(edge.nodes[0][0], d);
    q_to[d] = weight(edge.nodes[0][1], d);
  }
  if ((q_from[0] == 0 && q_to[0] == 0) || (edge.tip != none && !is_own(edge.tip))) return;
  constexpr int points = 5;
  for (const LinePoint& place : wall_rule(mesh_, edge, points)) {
    WallShare share{wall_point(edge, place), {}};
    const double upper =
        share.point.normal.y() < 0 ? 1 : -1;  // plus is above when the normal, towards minus, points down
    const double r = (share.point.x - tip_.room.position).norm();
    for (int f = 0; f < fields; ++f) {
      const auto plus = auxiliary_point(auxiliary_fields[f], rock_, r, upper * std::numbers::pi);
      const auto minus = auxiliary_point(auxiliary_fields[f], rock_, r, -upper * std::numbers::pi);
      const Point work = plus.displacement_along - minus.displacement_along;
      for (int d = 0; d < domains; ++d) {
        const double q = edge.tip != none ? 1 : q_from[d] + place.t * (q_to[d] - q_from[d]);
        share.of_traction.row(d * fields + f) = -share.point.weight * q * work.transpose();
      }
    }
    walls_.push_back(share);
  }
}

void InteractionIntegrals::add_places_of_fit() {
  for (const FineMesh::WallEdge& edge : mesh_.wall_edges) {
    const bool is_near = edge.crack == tip_.room.crack && edge.tip == none &&
                         (weight(edge.nodes[0][0], 0) > 0 || weight(edge.nodes[0][1], 0) > 0);
    if (!is_near) continue;
    constexpr int points = 3;
    for (const LinePoint& place : line_rule(points)) fit_.push_back(wall_point(edge, place));
  }
}

/// Where a jump is prescribed up to the tip, the traction there is bounded, but that of quarter-point elements is
/// not: the error of their angular resolution goes with r^-1/2. A line is fitted to the traction behind the rosette.
void InteractionIntegrals::fit_traction(State& state) const {
  Eigen::Matrix2d normal_matrix = Eigen::Matrix2d::Zero(), right_side = Eigen::Matrix2d::Zero();
  for (const WallPoint& point : fit_) {
    const Eigen::Vector2d row(1, (point.x - tip_.room.position).norm());
    normal_matrix += point.weight * row * row.transpose();
    right_side += point.weight * row * traction(state, point).transpose();
  }
  const Eigen::Matrix2d fit = normal_matrix.inverse() * right_side;
  state.fitted = {fit.row(0).transpose(), fit.row(1).transpose()};
}

/// The traction on the plus wall, in the frame of the tip.
Point InteractionIntegrals::traction(const State& state, const WallPoint& point) const {
  const FineMesh::WallEdge& edge = *point.edge;
  if (edge.walls == CrackPath::Walls::traction) return wall_traction(state, edge, point.x);
  if (edge.tip != none) return state.fitted[0] + (point.x - tip_.room.position).norm() * state.fitted[1];
  Tensor stress = state.offset(point.offset);
  for (int side = 0; side < 2; ++side) {
    const FineMesh::Element& element = mesh_.elements[edge.elements[side]];
    const auto [xi, eta] = place_on_edge(element, edge.nodes[side], point.t);
    stress += 0.5 * rock_by_place_.at(point.x).stress(
                        gradient(element, shape_point(mesh_, element, xi, eta), state.displacement));
  }
  return frame_.transpose() * stress * edge.normal;
}

Point InteractionIntegrals::wall_traction(const State& state, const FineMesh::WallEdge& edge, const Point& x) const {
  if (!state.loads.wall_traction) return Point::Zero();
  const WallPlace place = wall_place(mesh_, edge, x);
  return frame_.transpose() * state.loads.wall_traction(edge.crack, place.segment, place.s);
}

Point InteractionIntegrals::traction_at_tip(const State& state) const {
  SPREKK_ASSERT(own_wall_ != nullptr);
  if (own_wall_->walls == CrackPath::Walls::jump) return state.fitted[0];
  return wall_traction(state, *own_wall_, tip_.room.position);
}

std::array<InteractionResult, 2> InteractionIntegrals::of(const FineLoads& loads,
                                                          const Eigen::Ref<const Eigen::Matrix3Xd>& offsets,
                                                          const Eigen::Ref<const Eigen::Matrix2Xd>& body_forces,
                                                          const Vector& displacement) const {
  State state{loads, offsets, displacement};
  SPREKK_EXPECT(displacement.size() == 2 * mesh_.node_count(), displacement.size(), mesh_.node_count());
  SPREKK_EXPECT(offsets.cols() == 0 || offsets.cols() == static_cast<Eigen::Index>(offset_places_.size()),
                offsets.cols(), offset_places_.size());
  SPREKK_EXPECT(body_forces.cols() == 0 || body_forces.cols() == static_cast<Eigen::Index>(offset_places_.size()),
                body_forces.cols(), offset_places_.size());
  SPREKK_EXPECT(is_finite(displacement));
  SPREKK_ASSERT(own_wall_ != nullptr);
  if (!fit_.empty()) fit_traction(state);
  // The constant state has the traction that acts on the walls at the tip, and sigma_11 = 0.
  const Point t = traction_at_tip(state);
  const double sign = frame_.col(1).dot(own_wall_->normal) > 0 ? 1 : -1;
  Tensor constant;
  constant << 0, sign * t.x(), sign * t.x(), sign * t.y();
  const Tensor offset_at_tip = frame_.transpose() * state.offset(0) * frame_;
  const Tensor constant_strain = rock_.strain(constant - offset_at_tip);

  Sums sum = of_displacement_ * displacement - of_gradient_ * Eigen::Map<const Eigen::Vector4d>(constant_strain.data());
  if (offsets.cols() > 0)
    for (std::size_t i = 0; i < of_offset_.size(); ++i) sum += of_offset_[i] * (offsets.col(1 + i) - offsets.col(0));
  if (body_forces.cols() > 0)
    for (std::size_t i = 0; i < of_body_force_.size(); ++i) sum += of_body_force_[i] * body_forces.col(1 + i);
  for (const WallShare& share : walls_)
    sum += share.of_traction * (traction(state, share.point) - constant * share.point.normal);

  const double modulus = rock_.plane_modulus();
  const auto result = [&](int domain) -> InteractionResult {
    const Eigen::Vector3d of = sum.segment<fields>(domain * fields);
    return {{0.5 * modulus * of[0], 0.5 * modulus * of[1]}, modulus * of[2] - constant(1, 1)};
  };
  return {result(0), result(1)};
}

}  // namespace sprekk::fine_fracture
