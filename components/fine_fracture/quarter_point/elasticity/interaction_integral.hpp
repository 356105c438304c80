// The interaction integral in domain form.
#pragma once

#include <array>

#include "components/fine_fracture/fine_level/fine_rock.hpp"
#include "components/fine_fracture/fine_level/loads.hpp"
#include "components/fine_fracture/fine_level/quadrature.hpp"
#include "components/fine_fracture/quarter_point/mesh/fine_mesh.hpp"

namespace sprekk::fine_fracture {

/// K_I, K_II (Pa m^1/2) and sigma_11 - sigma_22 (Pa) at a tip.
struct InteractionResult {
  Point K;
  double T;
};

/// Interaction integrals around one tip. With total stress sigma = C eps(u) + s, auxiliary field a and a weight q that
/// is 1 at the tip and 0 at `radius`,
///
///   I = int_A [sigma_ij ua_i,1 q_,j + sa_ij u_i,1 q_,j - (sa : eps) q_,1 + q s : epsa_,1 - q b . ua_,1]
///       - int_walls q t . ua_,1
///
/// with the body force b. It is the usual domain form (Li, Shih and Needleman 1985; Yau, Wang and Corten 1980) after
/// div s has been integrated by parts: only values of s occur. Before, the constant state that the walls' traction and
/// s have at the tip is subtracted, so that integrals converge at the tip. K = E' I / 2, sigma_11 = E' I for a unit
/// force. Where the stiffness C(x) is not that at the tip, C, the stress is C eps + s with (C(x) - C) eps as a part of
/// s. Exact for walls that are straight within the radius. On walls of kind jump, t is the mean of both elements'
/// stress, in the rosette a line fitted to it from behind.
///
/// The integrals for two radii, the first one the larger, are computed together: they differ in q only. They are linear
/// in u, s, b and t; the coefficients follow from the mesh and are computed once.
class InteractionIntegrals {
 public:
  /// Keeps references to the mesh and to its tip.
  InteractionIntegrals(const FineMesh& mesh, const FineRock& rock, const FineMesh::Tip& tip,
                       const std::array<double, 2>& radii);
  /// The places at which stress offset and body force are needed.
  const std::vector<Point>& offset_places() const { return offset_places_; }
  /// The results for both radii. `offsets`: (xx, yy, xy) in Pa, a column for each place; no columns where there is no
  /// offset. `body_forces`: (x, y) in N/m^3, in the same way. `displacement`: (x, y) per node, m.
  std::array<InteractionResult, 2> of(const FineLoads& loads, const Eigen::Ref<const Eigen::Matrix3Xd>& offsets,
                                      const Eigen::Ref<const Eigen::Matrix2Xd>& body_forces,
                                      const Vector& displacement) const;

 private:
  static constexpr int domains = 2, fields = 3, sums = domains * fields;
  using Sums = Eigen::Vector<double, sums>;  ///< [domain][field]
  template <int columns>
  using Rows = Eigen::Matrix<double, sums, columns>;

  /// A place of integration on a wall.
  struct WallPoint {
    const FineMesh::WallEdge* edge;
    Point x, normal;  ///< the normal in the frame of the tip
    double t;         ///< parameter of the edge
    double weight;    ///< m
    int offset;       ///< its column of the offsets, or none
  };
  /// What the traction at a place on a wall adds to the integrals.
  struct WallShare {
    WallPoint point;
    Rows<2> of_traction;
  };
  struct State;  ///< of one solution

  bool is_own(int tip) const { return &mesh_.tips[tip] == &tip_; }
  double weight(int node, int domain) const;
  WallPoint wall_point(const FineMesh::WallEdge& edge, const LinePoint& place);
  void add_element(const FineMesh::Element& element);
  Point weight_gradient(const FineMesh::Element& element, const std::array<double, 3>& q) const;
  void add_wall(const FineMesh::WallEdge& edge);
  void add_places_of_fit();
  Point traction_at_tip(const State& state) const;
  Point wall_traction(const State& state, const FineMesh::WallEdge& edge, const Point& x) const;
  void fit_traction(State& state) const;
  Point traction(const State& state, const WallPoint& point) const;

  const FineMesh& mesh_;
  FineRock rock_by_place_;
  Elasticity rock_;  ///< at the tip
  const FineMesh::Tip& tip_;
  std::array<double, domains> radii_;
  Tensor frame_;                                  ///< columns x1, x2
  const FineMesh::WallEdge* own_wall_ = nullptr;  ///< an edge of the rosette
  std::vector<Point> offset_places_;              ///< the tip, those in elements, those on walls
  Rows<Eigen::Dynamic> of_displacement_;
  Rows<4> of_gradient_ = Rows<4>::Zero();  ///< of a constant one, in the frame of the tip
  std::vector<Rows<3>> of_offset_;         ///< by place in elements
  std::vector<Rows<2>> of_body_force_;     ///< by place in elements
  std::vector<WallShare> walls_;
  std::vector<WallPoint> fit_;
};

}  // namespace sprekk::fine_fracture
