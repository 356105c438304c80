// Forces at the tip of a crack, against the singular fields by Muskhelishvili's potentials.
#include "components/poromechanics/mpsa/plane/tip_field.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <complex>
#include <numbers>

#include "components/poromechanics/mpsa/mpsa.hpp"
#include "framework/discretization/ends_nearby.hpp"
#include "framework/discretization/plane/end_zones.hpp"
#include "tests/components/meshes.hpp"

namespace sprekk::poromechanics {
namespace {

using Complex = std::complex<double>;
using Conditions = std::vector<FaceConditions>;

constexpr double lambda = 3, shear = 2;

/// The field phi = a z^order of free walls, of stress-intensity factors K = K_I + i K_II for the order 1/2, at a tip
/// whose crack lies behind it along `angle`.
struct Singular {
  Point tip;
  double angle;
  Complex K;
  double order = 0.5;

  Complex a() const { return std::conj(K) / (2 * std::sqrt(2 * std::numbers::pi)); }
  Complex b() const { return std::conj(a()) - order * a(); }
  /// In the frame of the tip.
  Complex local(const Point& x) const { return Complex(x[0] - tip[0], x[1] - tip[1]) * std::polar(1.0, -angle); }

  /// 2 G (u + iv) = kappa phi - z conj(phi') - conj(psi), with the root continued across the line of the crack to where
  /// `side` (1: left of it) is seen from.
  Point displacement(const Point& x, int side = 0) const {
    const Complex z = local(x), principal = std::sqrt(z);
    const Complex root = z.real() < 0 && z.imag() * side < 0 ? -principal : principal;
    const Complex power = std::pow(z, order - 0.5) * root;
    const double kappa = 3 - 4 * lambda / (2 * (lambda + shear));
    const Complex u =
        (kappa * a() * power - z * std::conj(order * a() * power / z) - std::conj(b() * power)) / (2 * shear);
    const Complex turned = u * std::polar(1.0, angle);
    return {turned.real(), turned.imag()};
  }
  /// s_xx + s_yy = 4 Re phi', s_yy - s_xx + 2i s_xy = 2 (conj(z) phi'' + psi')
  Point traction(const Point& x, const Point& normal) const {
    const Complex z = local(x), slope = order * std::pow(z, order - 1);
    const double sum = 4 * (a() * slope).real();
    const Complex deviator = 2.0 * (std::conj(z) * (order - 1) * a() * slope / z + b() * slope);
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
  std::vector<int> nearby;  ///< nodes next to it
};

/// A crack on unstructured triangles, seen from its last end.
TipCase at_end_of(const std::vector<Point>& points) {
  Geometry geometry = test::box(1, 1);
  FractureGeometry crack;
  crack.name = "crack";
  crack.points = points;
  geometry.fractures = {crack};
  const Point ahead = points.back() - points[points.size() - 2];
  TipCase tip{
      generate_mesh(geometry, test::unstructured(0.05)), points.back(), std::atan2(ahead.y(), ahead.x()), none, {}, {}};
  for (int n = 0; n < tip.mesh.node_count(); ++n)
    if ((tip.mesh.nodes[n] - tip.tip).norm() < 1e-12) tip.node = n;
  const std::vector<int> tips = ends_nearby(tip.mesh);
  for (int n = 0; n < tip.mesh.node_count(); ++n)
    if (tips[n] == tip.node && tip.node != none) tip.nearby.push_back(n);
  tip.conditions.assign(tip.mesh.face_count(), {});
  for (int f = 0; f < tip.mesh.face_count(); ++f)
    if (test::is_outer(tip.mesh, f)) tip.conditions[f] = {MechanicalCondition::traction, MechanicalCondition::traction};
  return tip;
}

TipCase slanted() { return at_end_of({Point(0.3, 0.35), Point(0.65, 0.55)}); }

/// The forces and displacements of walls that the local problem of a node returns for displacements.
struct LocalAnswer {
  Vector force, trace, volume;

  LocalAnswer(const TipCase& tip, int node, const Vector& displacement) {
    std::vector<char> nodes(tip.mesh.node_count(), 0);
    nodes[node] = 1;
    const std::vector<Stiffness> rock(tip.mesh.cell_count(), isotropic_stiffness(lambda, shear));
    const StressOperators operators = discretize_mpsa(tip.mesh, rock, tip.conditions, nodes);
    force = operators.force_displacement * displacement;
    trace = operators.trace_displacement * displacement;
    volume = operators.volume_displacement * displacement;
  }
};

/// The integral of a function of a point over the line from a to b, at one of which it may go with 1 / sqrt(r).
template <class Function>
auto integral(const Point& a, const Point& b, const Function& value) {
  constexpr int count = 2000;
  auto sum = value(0.5 * (a + b));
  sum *= 0;
  for (int i = 0; i < count; ++i) {
    const double t = (i + 0.5) / count;  // x = 3 t^2 - 2 t^3 is flat at both ends
    sum += value(a + t * t * (3 - 2 * t) * (b - a)) * (6 * t * (1 - t) / count);
  }
  return Point(sum * (b - a).norm());
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

TEST(TipField, LocalProblemsNearATipAreExactForBothModesOfBothOrders) {
  const TipCase tip = slanted();
  ASSERT_GT(tip.nearby.size(), 20u);
  const Mesh& mesh = tip.mesh;
  for (const Singular& field :
       {Singular{tip.tip, tip.angle, 1.0}, Singular{tip.tip, tip.angle, Complex(0, 1)},
        Singular{tip.tip, tip.angle, 1.0, 1.5}, Singular{tip.tip, tip.angle, Complex(0, 1), 1.5},
        Singular{tip.tip, tip.angle, Complex(0.6, -0.8)}}) {
    const Vector u = in_cells(mesh, [&](const Point& x) { return field.displacement(x); });
    int inner = 0, walls = 0;
    for (const int node : tip.nearby) {
      const LocalAnswer answer(tip, node, u);
      for (const int face : mesh.node_faces[node]) {
        if (test::is_outer(mesh, face)) {
          // A point of the wall, a little inside the rock: the function has its cut along the crack.
          const Point center = mesh.face_center[face] - 1e-14 * mesh.face_normal[face];
          const Point exact = 0.5 * field.displacement(center);
          EXPECT_LT((answer.trace.segment<2>(2 * face) - exact).norm(), 1e-8) << face;
          ++walls;
          continue;
        }
        const Point exact = integral(mesh.nodes[node], mesh.face_center[face],
                                     [&](const Point& x) { return field.traction(x, mesh.face_normal[face]); });
        EXPECT_LT((answer.force.segment<2>(2 * face) - exact).norm(), 1e-6) << face << " at " << node;
        ++inner;
      }
    }
    EXPECT_GT(inner, 100);
    EXPECT_EQ(walls, 2 + 2 * 2 * 3);  // one face a wall at the tip, two at each of three nodes beside
  }
}

TEST(TipField, VolumeChangesNearATipAreExactForBothModesOfBothOrders) {
  const TipCase tip = slanted();
  const Mesh& mesh = tip.mesh;
  const Singular field{tip.tip, tip.angle, Complex(0.6, -0.8)}, next{tip.tip, tip.angle, Complex(-0.8, -0.6), 1.5};
  const auto displacement = [&](const Point& x) -> Point { return field.displacement(x) + 2 * next.displacement(x); };
  const Vector u = in_cells(mesh, displacement);
  for (const int node : tip.nearby) {
    const LocalAnswer answer(tip, node, u);
    for (const int cell : mesh.node_cells[node]) {
      std::vector<Point> ends;
      for (const int face : mesh.cell_faces[cell])
        if (mesh.face_nodes[face][0] == node || mesh.face_nodes[face][1] == node)
          ends.push_back(mesh.face_center[face]);
      ASSERT_EQ(ends.size(), 2u);
      // What flows out of the subcell, seen from the inside.
      const Point center = mesh.cell_center[cell];
      const Point corners[4] = {mesh.nodes[node], ends[0], center, ends[1]};
      const Point diagonal[2] = {corners[2] - corners[0], corners[3] - corners[1]};
      const double turn = diagonal[0].x() * diagonal[1].y() > diagonal[0].y() * diagonal[1].x() ? 1 : -1;
      double exact = 0;
      for (int i = 0; i < 4; ++i) {
        const Point a = corners[i], b = corners[(i + 1) % 4];
        const Point normal = turn * Point(b.y() - a.y(), a.x() - b.x()).normalized();
        exact += integral(a, b, [&](const Point& x) { return displacement(x - 1e-13 * normal); }).dot(normal);
      }
      EXPECT_NEAR(answer.volume[cell], exact, 1e-7) << cell << " at " << node;
    }
  }
}

// Mean stresses of the cells whose nodes are all near the tip, from forces on faces and their moments: V sigma = sum of
// force (x_face - x_cell) + moment. The error is that of Gauss's rule.
TEST(TipField, MeanStressesNearATipAreExactForBothModesOfBothOrders) {
  const TipCase tip = slanted();
  const Mesh& mesh = tip.mesh;
  const StressOperators operators = discretize_mpsa(mesh, even(mesh), tip.conditions);
  const auto is_near = [&](int node) { return std::ranges::find(tip.nearby, node) != tip.nearby.end(); };
  for (const Singular& field : {Singular{tip.tip, tip.angle, 1.0}, Singular{tip.tip, tip.angle, Complex(0, 1)},
                                Singular{tip.tip, tip.angle, Complex(0.6, -0.8), 1.5}}) {
    const Vector u = in_cells(mesh, [&](const Point& x) { return field.displacement(x); });
    const Vector forces = operators.force_displacement * u, moments = operators.moment_displacement * u;
    int cells = 0, at_tip = 0;
    for (int c = 0; c < mesh.cell_count(); ++c) {
      if (!std::ranges::all_of(mesh.cell_nodes[c], is_near)) continue;
      Eigen::Vector3d stress = Eigen::Vector3d::Zero(), exact = stress;
      for (const int face : mesh.cell_faces[c]) {
        if (test::is_outer(mesh, face)) continue;  // a wall without traction
        const double sign = mesh.face_cells[face][0] == c ? 1 : -1;
        const Point force = sign * forces.segment<2>(2 * face), arm = mesh.face_center[face] - mesh.cell_center[c];
        stress += Eigen::Vector3d(force[0] * arm[0], force[1] * arm[1], 0.5 * (force[0] * arm[1] + force[1] * arm[0])) +
                  sign * moments.segment<3>(3 * face);
        const auto [a, b] = mesh.face_nodes[face];
        const auto with_arm = [&](int direction) {
          return integral(mesh.nodes[a], mesh.nodes[b], [&](const Point& x) -> Point {
            return sign * (x - mesh.cell_center[c])[direction] * field.traction(x, mesh.face_normal[face]);
          });
        };
        const Point x = with_arm(0), y = with_arm(1);
        exact += Eigen::Vector3d(x[0], y[1], 0.5 * (x[1] + y[0]));
      }
      EXPECT_LT((stress - exact).norm(), 1e-5 * exact.norm()) << c;
      ++cells;
      at_tip += std::ranges::find(mesh.cell_nodes[c], tip.node) != mesh.cell_nodes[c].end();
    }
    EXPECT_GT(cells, 30);
    EXPECT_GE(at_tip, 5);
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
  const Vector u = in_cells(tip.mesh, [&](const Point& x) -> Point { return (strain + turn) * x; });
  for (const int node : tip.nearby) {
    const LocalAnswer answer(tip, node, u);
    for (const int face : tip.mesh.node_faces[node]) {
      const Point stretched = 0.5 * (strain + turn) * tip.mesh.face_center[face];
      const Point force = 0.5 * tip.mesh.face_measure[face] * (stress * tip.mesh.face_normal[face]);
      if (test::is_outer(tip.mesh, face))
        EXPECT_LT((answer.trace.segment<2>(2 * face) - stretched).norm(), 1e-12) << face;
      else
        EXPECT_LT((answer.force.segment<2>(2 * face) - force).norm(), 1e-12) << face;
    }
  }
}

TEST(TipField, WallsOfACrackThatBendsHaveTheirOwnSides) {
  // Behind a bend of 9 degrees, one cell from the tip, the crack is off the tip's line by more than centres of cells
  // are off the crack.
  const double bend = 9 * M_PI / 180;
  for (const int turn : {1, -1}) {
    const Point kink(0.55, 0.5), back = kink - Point(0.3, 0);
    const TipCase tip = at_end_of({back, kink, kink + 0.05 * Point(std::cos(bend), turn * std::sin(bend))});
    const Mesh& mesh = tip.mesh;
    const auto side_of = [&](const Point& x) {
      const Point along = x.x() < kink.x() ? Point(1, 0) : Point(tip.tip - kink), from = x - kink;
      return along.x() * from.y() > along.y() * from.x() ? 1 : -1;
    };
    const Singular field{tip.tip, tip.angle, Complex(0.6, -0.8)};
    const Vector u = in_cells(mesh, [&](const Point& x) { return field.displacement(x, side_of(x)); });
    int across = 0, walls = 0;
    for (const int node : tip.nearby) {
      const LocalAnswer answer(tip, node, u);
      for (const int face : mesh.node_faces[node]) {
        if (!test::is_outer(mesh, face)) continue;
        const Point& cell = mesh.cell_center[mesh.face_cells[face][0]];
        across += field.local(cell).imag() * side_of(cell) < 0;
        ++walls;
        const Point exact = 0.5 * field.displacement(mesh.face_center[face], side_of(cell));
        EXPECT_LT((answer.trace.segment<2>(2 * face) - exact).norm(), 1e-8) << face << " at " << node;
      }
    }
    EXPECT_EQ(walls, 2 + 2 * 2 * 3);  // at the tip one a side, at three nodes on each side two
    EXPECT_GT(across, 0) << "no cell is on the other side of the tip's line";
  }
}

TEST(TipField, RockThatChangesALittleKeepsIt) {
  const TipCase tip = slanted();
  std::vector<Stiffness> rock = even(tip.mesh);
  for (int c = 0; c < tip.mesh.cell_count(); ++c) rock[c] *= 1 + 0.3 * tip.mesh.cell_center[c].x();
  const auto field = TipField::find(tip.mesh, tip.node, end_zones(tip.mesh).cells.at(tip.node), rock);
  ASSERT_TRUE(field.has_value());
  EXPECT_NEAR(field->rock()(2, 2), shear * (1 + 0.3 * tip.tip.x()), 0.02 * shear);
}

TEST(TipField, IsLeftOutWhereTheRockChangesOrIsAnisotropic) {
  const TipCase tip = slanted();
  std::vector<Stiffness> layered = even(tip.mesh), anisotropic = even(tip.mesh);
  layered[tip.mesh.node_cells[tip.node][0]] *= 2;
  for (Stiffness& stiffness : anisotropic) stiffness(0, 0) *= 2;
  const std::vector<int> cells = end_zones(tip.mesh).cells.at(tip.node);
  EXPECT_TRUE(TipField::find(tip.mesh, tip.node, cells, even(tip.mesh)).has_value());
  EXPECT_FALSE(TipField::find(tip.mesh, tip.node, cells, layered).has_value());
  EXPECT_FALSE(TipField::find(tip.mesh, tip.node, cells, anisotropic).has_value());
}

TEST(TipsNearby, AreWithinThreeEdgesAndNotAcrossAKink) {
  Geometry geometry = test::box(1, 1);
  FractureGeometry crack;
  crack.name = "crack";
  crack.points = {Point(0.3, 0.4), Point(0.5, 0.4), Point(0.6, 0.5)};
  geometry.fractures = {crack};
  const Mesh mesh = generate_mesh(geometry, test::unstructured(0.05));
  const std::vector<int> tips = ends_nearby(mesh);
  int straight = 0, bent = 0;
  for (int n = 0; n < mesh.node_count(); ++n) {
    const double first = (mesh.nodes[n] - crack.points[0]).norm(), last = (mesh.nodes[n] - crack.points[2]).norm();
    const double kink = (mesh.nodes[n] - crack.points[1]).norm();
    if (tips[n] == none) {
      EXPECT_GT(std::min(first, last), kink < 0.06 ? 0.03 : 0.1) << n;
      continue;
    }
    const Point& tip = mesh.nodes[tips[n]];
    EXPECT_LT((tip - crack.points[first < last ? 0 : 2]).norm(), 1e-12) << n;
    EXPECT_LT(std::min(first, last), 3 * 0.075) << n;
    EXPECT_GT(kink, 1e-12) << "the kink itself has two directions";
    (first < last ? straight : bent) += 1;
  }
  EXPECT_GT(straight, 25);
  EXPECT_GT(bent, 20);
}

}  // namespace
}  // namespace sprekk::poromechanics
