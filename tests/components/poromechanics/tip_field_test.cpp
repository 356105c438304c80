// Forces at the tip of a crack, against the singular fields by Muskhelishvili's potentials.
#include "components/poromechanics/mpsa/tip_field.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <complex>
#include <numbers>

#include "tests/components/meshes.hpp"

namespace sprekk::poromechanics {
namespace {

using Complex = std::complex<double>;
using Conditions = std::vector<std::array<MechanicalCondition, 2>>;

constexpr double lambda = 3, shear = 2;

/// The field of stress-intensity factors K = K_I + i K_II at a tip whose crack lies behind it along `angle`.
struct Singular {
  Point tip;
  double angle;
  Complex K;

  Complex a() const { return std::conj(K) / (2 * std::sqrt(2 * std::numbers::pi)); }
  Complex b() const { return std::conj(a()) - 0.5 * a(); }
  /// In the frame of the tip.
  Complex local(const Point& x) const { return Complex(x[0] - tip[0], x[1] - tip[1]) * std::polar(1.0, -angle); }

  /// 2 G (u + iv) = kappa phi - z conj(phi') - conj(psi)
  Point displacement(const Point& x) const {
    const Complex z = local(x), root = std::sqrt(z);
    const double kappa = 3 - 4 * lambda / (2 * (lambda + shear));
    const Complex u = (2 * kappa * a() * root - z * std::conj(a() / root) - std::conj(2.0 * b() * root)) / (2 * shear);
    const Complex turned = u * std::polar(1.0, angle);
    return {turned.real(), turned.imag()};
  }
  /// s_xx + s_yy = 4 Re phi', s_yy - s_xx + 2i s_xy = 2 (conj(z) phi'' + psi')
  Point traction(const Point& x, const Point& normal) const {
    const Complex z = local(x), root = std::sqrt(z);
    const double sum = 4 * (a() / root).real();
    const Complex deviator = 2.0 * (std::conj(z) * (-0.5 * a() / (root * z)) + b() / root);
    const Complex n = Complex(normal[0], normal[1]) * std::polar(1.0, -angle);
    const double xx = 0.5 * (sum - deviator.real()), yy = 0.5 * (sum + deviator.real()), xy = 0.5 * deviator.imag();
    const Complex t = Complex(xx * n.real() + xy * n.imag(), xy * n.real() + yy * n.imag()) * std::polar(1.0, angle);
    return {t.real(), t.imag()};
  }
};

struct TipCase {
  Mesh mesh;
  Point tip;
  double angle;
  int node = none;
  Conditions conditions;
};

/// A slanted crack on unstructured triangles, seen from its last end.
TipCase slanted() {
  Geometry geometry = test::box(1, 1);
  FractureGeometry crack;
  crack.name = "crack";
  crack.points = {Point(0.3, 0.35), Point(0.65, 0.55)};
  geometry.fractures = {crack};
  TipCase tip{generate_mesh(geometry, test::unstructured(0.08)), crack.points[1], std::atan2(0.2, 0.35), none, {}};
  for (int n = 0; n < tip.mesh.node_count(); ++n)
    if ((tip.mesh.nodes[n] - tip.tip).norm() < 1e-12) tip.node = n;
  tip.conditions.assign(tip.mesh.face_count(), {MechanicalCondition::none, MechanicalCondition::none});
  for (int f = 0; f < tip.mesh.face_count(); ++f)
    if (test::is_outer(tip.mesh, f)) tip.conditions[f] = {MechanicalCondition::traction, MechanicalCondition::traction};
  return tip;
}

/// The forces on the faces at the tip that its local problem makes of displacements.
Vector forces_at_tip(const TipCase& tip, const std::vector<Stiffness>& rock, const Vector& displacement) {
  std::vector<char> nodes(tip.mesh.node_count(), 0);
  nodes[tip.node] = 1;
  return discretize_mpsa(tip.mesh, rock, tip.conditions, nodes).force_displacement * displacement;
}

std::vector<Stiffness> even(const Mesh& mesh) {
  return std::vector<Stiffness>(mesh.cell_count(), isotropic_stiffness(lambda, shear));
}

template <class Function>
Vector in_cells(const Mesh& mesh, const Function& u) {
  Vector values(2 * mesh.cell_count());
  for (int c = 0; c < mesh.cell_count(); ++c) values.segment<2>(2 * c) = u(mesh.cell_center[c]);
  return values;
}

TEST(TipField, ForcesAroundATipAreExactForBothModes) {
  const TipCase tip = slanted();
  ASSERT_NE(tip.node, none);
  for (const Complex K : {Complex(1, 0), Complex(0, 1), Complex(0.6, -0.8)}) {
    const Singular field{tip.tip, tip.angle, K};
    const Vector force =
        forces_at_tip(tip, even(tip.mesh), in_cells(tip.mesh, [&](const Point& x) { return field.displacement(x); }));
    int inner = 0;
    for (const int face : tip.mesh.node_faces[tip.node]) {
      if (test::is_outer(tip.mesh, face)) continue;
      ++inner;
      // Over the half of the face at the tip, where the traction goes with 1 / sqrt(r).
      const double half = 0.5 * tip.mesh.face_length[face];
      const Point exact = 2 * half * field.traction(tip.mesh.face_center[face], tip.mesh.face_normal[face]);
      EXPECT_LT((force.segment<2>(2 * face) - exact).norm(), 1e-10) << face;
    }
    EXPECT_GE(inner, 4);
  }
}

TEST(TipField, LinearDisplacementsStayExact) {
  const TipCase tip = slanted();
  // A stretch along the crack, without traction on its walls.
  const Point along(std::cos(tip.angle), std::sin(tip.angle));
  const Tensor stress = along * along.transpose();
  const double poisson = lambda / (2 * (lambda + shear));
  const Tensor strain = (stress - poisson * stress.trace() * Tensor::Identity()) / (2 * shear);
  Tensor turn;
  turn << 0, -0.7, 0.7, 0;
  const Vector force = forces_at_tip(tip, even(tip.mesh),
                                     in_cells(tip.mesh, [&](const Point& x) -> Point { return (strain + turn) * x; }));
  for (const int face : tip.mesh.node_faces[tip.node]) {
    if (test::is_outer(tip.mesh, face)) continue;
    const Point exact = 0.5 * tip.mesh.face_length[face] * (stress * tip.mesh.face_normal[face]);
    EXPECT_LT((force.segment<2>(2 * face) - exact).norm(), 1e-12) << face;
  }
}

TEST(TipField, IsLeftOutWhereTheRockChangesOrIsAnisotropic) {
  const TipCase tip = slanted();
  std::vector<Stiffness> layered = even(tip.mesh), anisotropic = even(tip.mesh);
  layered[tip.mesh.node_cells[tip.node][0]] *= 2;
  for (Stiffness& stiffness : anisotropic) stiffness(0, 0) *= 2;
  InteractionRegion region;
  region.assign(tip.mesh, tip.node);
  const auto cells = tip.mesh.node_cells[tip.node];
  EXPECT_TRUE(TipField::find(tip.mesh, region, cells, even(tip.mesh)).has_value());
  EXPECT_FALSE(TipField::find(tip.mesh, region, cells, layered).has_value());
  EXPECT_FALSE(TipField::find(tip.mesh, region, cells, anisotropic).has_value());
  for (int n = 0; n < tip.mesh.node_count(); ++n) {
    if ((tip.mesh.nodes[n] - tip.tip).norm() < 1e-12 || (tip.mesh.nodes[n] - Point(0.3, 0.35)).norm() < 1e-12) continue;
    region.assign(tip.mesh, n);
    EXPECT_FALSE(TipField::find(tip.mesh, region, tip.mesh.node_cells[n], even(tip.mesh)).has_value()) << n;
  }
}

}  // namespace
}  // namespace sprekk::poromechanics
