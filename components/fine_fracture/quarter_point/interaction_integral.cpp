#include "components/fine_fracture/quarter_point/interaction_integral.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "components/fine_fracture/quarter_point/auxiliary_field.hpp"
#include "components/fine_fracture/quarter_point/quadrature.hpp"
#include "components/fine_fracture/quarter_point/shapes.hpp"
#include "components/fine_fracture/quarter_point/wall_place.hpp"
#include "framework/mesh/mesh.hpp"

namespace sprekk::fine_fracture {
namespace {

constexpr std::array fields = {Auxiliary::opening, Auxiliary::sliding, Auxiliary::force};

class Integral {
 public:
  Integral(const FineMesh& mesh, const Elasticity& rock, const FineLoads& loads, const Vector& displacement,
           const FineMesh::Tip& tip, const std::array<double, 2>& radii)
      : mesh_(mesh), rock_(rock), loads_(loads), displacement_(displacement), tip_(tip), radii_(radii) {
    const Point& x1 = tip.room.direction;
    frame_ << x1.x(), -x1.y(), x1.y(), x1.x();
    subtract_constant_state();
    for (const FineMesh::Element& element : mesh.elements) add_element(element);
    for (const FineMesh::WallEdge& edge : mesh.wall_edges) {
      if (edge.crack == tip.room.crack) add_wall(edge);
    }
  }

  InteractionResult result(int domain) const {
    const double modulus = rock_.plane_modulus();
    const auto& sum = sums_[domain];
    return {{0.5 * modulus * sum[0], 0.5 * modulus * sum[1]}, modulus * sum[2] - constant_(1, 1)};
  }

 private:
  static constexpr int domains = 2;

  bool is_own(const FineMesh::WallEdge& edge) const { return edge.tip != none && &mesh_.tips[edge.tip] == &tip_; }

  Tensor turned(const Tensor& global) const { return frame_.transpose() * global * frame_; }
  Tensor offset(const Point& x) const {
    return loads_.stress_offset ? turned(symmetric(loads_.stress_offset(x))) : Tensor::Zero();
  }

  /// The constant state has the traction that acts on the walls at the tip, and sigma_11 = 0.
  void subtract_constant_state() {
    offset_at_tip_ = offset(tip_.room.position);
    for (const FineMesh::WallEdge& edge : mesh_.wall_edges) {
      if (!is_own(edge)) continue;
      const Point normal = frame_.transpose() * edge.normal;
      if (edge.walls == CrackPath::Walls::jump) fit_traction();
      const Point t = edge.walls == CrackPath::Walls::jump
                          ? fitted_traction_[0]
                          : Point(frame_.transpose() * wall_traction(tip_.room.position, edge));
      const double sign = normal.y() > 0 ? 1 : -1;
      constant_ << 0, sign * t.x(), sign * t.x(), sign * t.y();
    }
    constant_strain_ = rock_.strain(constant_ - offset_at_tip_);
  }

  /// Where a jump is prescribed up to the tip, the traction there is bounded, but that of quarter-point elements is
  /// not: the error of their angular resolution goes with r^-1/2. A line is fitted to the traction behind the rosette.
  void fit_traction() {
    Eigen::Matrix2d normal_matrix = Eigen::Matrix2d::Zero(), right_side = Eigen::Matrix2d::Zero();
    for (const FineMesh::WallEdge& edge : mesh_.wall_edges) {
      const bool is_near = edge.crack == tip_.room.crack && edge.tip == none &&
                           (weight(edge.nodes[0][0], 0) > 0 || weight(edge.nodes[0][1], 0) > 0);
      if (!is_near) continue;
      const Point normal = frame_.transpose() * edge.normal;
      constexpr int points = 3;
      for (const LinePoint& place : line_rule(points)) {
        const EdgePoint p = edge_point(mesh_, edge.nodes[0], place.t);
        const Eigen::Vector2d row(1, (p.x - tip_.room.position).norm());
        normal_matrix += place.weight * p.jacobian * row * row.transpose();
        right_side += place.weight * p.jacobian * row * traction_here(edge, p.x, place.t, normal).transpose();
      }
    }
    const Eigen::Matrix2d fit = normal_matrix.inverse() * right_side;
    fitted_traction_ = {fit.row(0).transpose(), fit.row(1).transpose()};
  }

  Point wall_traction(const Point& x, const FineMesh::WallEdge& edge) const {
    if (!loads_.wall_traction) return Point::Zero();
    const WallPlace place = wall_place(mesh_, edge, x);
    return loads_.wall_traction(edge.crack, place.segment, place.s);
  }

  /// That for domain 0, the larger one, is 0 only where the others are.
  double weight(int node, int domain) const {
    const double r = (mesh_.nodes[node] - tip_.room.position).norm(), inner = tip_.room.radius;
    return std::clamp((radii_[domain] - r) / (radii_[domain] - inner), 0.0, 1.0);
  }

  /// du_i/dx_j in the frame of the tip.
  Tensor gradient(const FineMesh::Element& element, const ShapePoint& p) const {
    Tensor g = Tensor::Zero();
    for (int k = 0; k < 6; ++k) g += displacement_.segment<2>(2 * element.nodes[k]) * p.gradient.row(k);
    return turned(g);
  }

  void add_element(const FineMesh::Element& element) {
    std::array<std::array<double, 3>, domains> q;
    for (int k = 0; k < 3; ++k) q[0][k] = weight(element.nodes[k], 0);
    if (q[0] == std::array<double, 3>{}) return;
    const bool is_rosette = element.tip != none;
    if (is_rosette && !loads_.stress_offset) return;  // the weight is constant there
    std::array<Point, domains> dq;
    for (int d = 0; d < domains; ++d) {
      for (int k = 0; k < 3; ++k) q[d][k] = weight(element.nodes[k], d);
      dq[d] = is_rosette ? Point(0, 0) : weight_gradient(element, q[d]);
    }
    constexpr int along_rays = 4, across = 5, degree = 6;
    for (const TrianglePoint& place : is_rosette ? polar_rule(along_rays, across) : triangle_rule(degree)) {
      const ShapePoint p = shape_point(mesh_, element, place.xi, place.eta);
      const Tensor g = gradient(element, p);
      const Tensor strain = 0.5 * (g + g.transpose()) - constant_strain_;
      const Tensor stress_offset = offset(p.x) - offset_at_tip_;
      const Tensor stress = rock_.stress(strain) + stress_offset;
      const Point along = g.col(0) - constant_strain_.col(0);
      const Point x = frame_.transpose() * (p.x - tip_.room.position);
      const double factor = place.weight * p.jacobian;
      const std::array<AuxiliaryPoint, 3> auxiliary = auxiliary_points(rock_, x);
      for (std::size_t f = 0; f < fields.size(); ++f) {
        const AuxiliaryPoint& a = auxiliary[f];
        const Point flux =
            stress * a.displacement_along + a.stress * along - Point(a.stress.cwiseProduct(strain).sum(), 0);
        const double source = stress_offset.cwiseProduct(a.strain_along).sum();
        for (int d = 0; d < domains; ++d) {
          const double q_here =
              is_rosette ? 1 : q[d][0] + place.xi * (q[d][1] - q[d][0]) + place.eta * (q[d][2] - q[d][0]);
          sums_[d][f] += factor * (flux.dot(dq[d]) + q_here * source);
        }
      }
    }
  }

  Point weight_gradient(const FineMesh::Element& element, const std::array<double, 3>& q) const {
    const Point a = mesh_.nodes[element.nodes[1]] - mesh_.nodes[element.nodes[0]];
    const Point b = mesh_.nodes[element.nodes[2]] - mesh_.nodes[element.nodes[0]];
    const double determinant = a.x() * b.y() - a.y() * b.x();
    const double da = (q[1] - q[0]) / determinant, db = (q[2] - q[0]) / determinant;
    return frame_.transpose() * Point(da * b.y() - db * a.y(), db * a.x() - da * b.x());
  }

  void add_wall(const FineMesh::WallEdge& edge) {
    std::array<double, domains> q_from, q_to;
    for (int d = 0; d < domains; ++d) {
      q_from[d] = weight(edge.nodes[0][0], d);
      q_to[d] = weight(edge.nodes[0][1], d);
    }
    if (q_from[0] == 0 && q_to[0] == 0) return;
    const Point normal = frame_.transpose() * edge.normal;
    const double upper = normal.y() < 0 ? 1 : -1;  // plus is above when the normal, towards minus, points down
    constexpr int points = 5;
    for (const LinePoint& place : wall_rule(mesh_, edge, points)) {
      const EdgePoint p = edge_point(mesh_, edge.nodes[0], place.t);
      const Point t = traction_here(edge, p.x, place.t, normal) - constant_ * normal;
      const double r = (p.x - tip_.room.position).norm();
      for (std::size_t f = 0; f < fields.size(); ++f) {
        const auto plus = auxiliary_point(fields[f], rock_, r, upper * std::numbers::pi);
        const auto minus = auxiliary_point(fields[f], rock_, r, -upper * std::numbers::pi);
        const double work = t.dot(plus.displacement_along - minus.displacement_along);
        for (int d = 0; d < domains; ++d) {
          const double q = edge.tip != none ? 1 : q_from[d] + place.t * (q_to[d] - q_from[d]);
          sums_[d][f] -= place.weight * p.jacobian * q * work;
        }
      }
    }
  }

  /// On the plus wall, in the frame of the tip. t runs along the edge's parameter.
  Point traction_here(const FineMesh::WallEdge& edge, const Point& x, double t, const Point& normal) const {
    if (edge.walls == CrackPath::Walls::traction) return frame_.transpose() * wall_traction(x, edge);
    if (edge.tip != none) return fitted_traction_[0] + (x - tip_.room.position).norm() * fitted_traction_[1];
    Tensor stress = offset(x);
    for (int side = 0; side < 2; ++side) {
      const FineMesh::Element& element = mesh_.elements[edge.elements[side]];
      const auto [xi, eta] = place_on_edge(element, edge.nodes[side], t);
      const Tensor g = gradient(element, shape_point(mesh_, element, xi, eta));
      stress += 0.5 * rock_.stress(0.5 * (g + g.transpose()));
    }
    return stress * normal;
  }

  /// Local coordinates of the element at a place on one of its edges.
  static std::array<double, 2> place_on_edge(const FineMesh::Element& element, const EdgeNodes& nodes, double t) {
    std::array<double, 3> corner_share{};
    for (int k = 0; k < 3; ++k) {
      if (element.nodes[k] == nodes[0]) corner_share[k] = 1 - t;
      if (element.nodes[k] == nodes[1]) corner_share[k] = t;
    }
    return {corner_share[1], corner_share[2]};
  }

  const FineMesh& mesh_;
  const Elasticity& rock_;
  const FineLoads& loads_;
  const Vector& displacement_;
  const FineMesh::Tip& tip_;
  std::array<double, domains> radii_;
  Tensor frame_;  ///< columns x1, x2
  Tensor offset_at_tip_, constant_, constant_strain_;
  std::array<Point, 2> fitted_traction_{Point(0, 0), Point(0, 0)};  ///< at the tip, and its change with r
  std::array<std::array<double, 3>, domains> sums_{};
};

}  // namespace

std::array<InteractionResult, 2> interaction_integrals(const FineMesh& mesh, const Elasticity& rock,
                                                       const FineLoads& loads, const Vector& displacement,
                                                       const FineMesh::Tip& tip, const std::array<double, 2>& radii) {
  const Integral integral(mesh, rock, loads, displacement, tip, radii);
  return {integral.result(0), integral.result(1)};
}

}  // namespace sprekk::fine_fracture
