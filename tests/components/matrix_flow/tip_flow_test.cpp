// Fluxes near the tip of a fracture, against conjugate functions of the flow around it.
#include "components/matrix_flow/mpfa/tip_flow.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <complex>

#include "components/matrix_flow/cells_around_tips.hpp"
#include "components/matrix_flow/mpfa/mpfa.hpp"
#include "framework/discretization/ends_nearby.hpp"
#include "tests/components/meshes.hpp"

namespace sprekk::matrix_flow {
namespace {

using Complex = std::complex<double>;

constexpr double mobility = 3;

/// p = Re w, with w = amount sqrt(z) + gradient z, and z in the frame of a tip whose fracture lies behind it along
/// `angle`. Flux through a line: mobility times the difference of Im w. A real amount flows through the walls, an
/// imaginary one passes them by.
struct Flow {
  Point tip;
  double angle;
  Complex amount, gradient;

  /// `side`: from where a point on the line of the fracture is seen.
  Complex potential(const Point& x, int side) const {
    const Complex z = Complex(x[0] - tip[0], x[1] - tip[1]) * std::polar(1.0, -angle);
    Complex root = std::sqrt(z);
    if (side != 0 && z.real() < 0 && z.imag() * side < 1e-12)
      root = Complex(std::abs(root.real()), side * std::abs(root.imag()));
    return amount * root + gradient * z;
  }
  /// Out of the first cell of a face.
  double flux(const Mesh& mesh, int face) const {
    const Point &a = mesh.nodes[mesh.face_nodes[face][0]], &b = mesh.nodes[mesh.face_nodes[face][1]];
    const Point inside = mesh.cell_center[mesh.face_cells[face][0]] - tip;
    const int side = -std::sin(angle) * inside[0] + std::cos(angle) * inside[1] < 0 ? -1 : 1;
    const double to_right = -mobility * (potential(b, side).imag() - potential(a, side).imag());
    const Point along = b - a;
    return Point(along.y(), -along.x()).dot(mesh.face_normal[face]) > 0 ? to_right : -to_right;
  }
};

struct TipCase {
  Mesh mesh;
  Point tip;
  double angle;
  int node = none;
};

TipCase slanted(const MeshOptions& options) {
  Geometry geometry = test::box(1, 1);
  FractureGeometry crack;
  crack.name = "crack";
  crack.points = {Point(0.3, 0.35), Point(0.65, 0.55)};
  geometry.fractures = {crack};
  TipCase tip{generate_mesh(geometry, options), crack.points[1], std::atan2(0.2, 0.35)};
  for (int n = 0; n < tip.mesh.node_count(); ++n)
    if ((tip.mesh.nodes[n] - tip.tip).norm() < 1e-12) tip.node = n;
  return tip;
}

struct Answer {
  Vector flux, trace;
};

Answer discretized(const Mesh& mesh, const Flow& flow) {
  std::vector<FlowCondition> conditions(mesh.face_count(), FlowCondition::none);
  Vector p(mesh.cell_count()), b = Vector::Zero(mesh.face_count());
  for (int f = 0; f < mesh.face_count(); ++f)
    if (test::is_outer(mesh, f)) {
      conditions[f] = FlowCondition::flux;
      b[f] = flow.flux(mesh, f);
    }
  for (int c = 0; c < mesh.cell_count(); ++c) p[c] = flow.potential(mesh.cell_center[c], 0).real();
  const std::vector<Tensor> rock(mesh.cell_count(), mobility * Tensor::Identity());
  const FluxOperators operators = discretize_mpfa(mesh, rock, conditions);
  return {operators.flux_cell * p + operators.flux_boundary * b,
          operators.trace_cell * p + operators.trace_boundary * b};
}

TEST(TipFlow, FluxesNearATipAreExactForItBesideLinearPressures) {
  for (const MeshOptions& options : {test::unstructured(0.05), test::mixed(0.05)}) {
    const TipCase tip = slanted(options);
    const Mesh& mesh = tip.mesh;
    const std::vector<int> tips = ends_nearby(mesh);
    for (const Complex amount : {Complex(0.7, 0), Complex(0, 0.7), Complex(-0.3, 0.8)}) {
      const Flow flow{tip.tip, tip.angle, amount, {-0.4, 0.9}};
      const Answer answer = discretized(mesh, flow);
      int inner = 0, walls = 0;
      for (int f = 0; f < mesh.face_count(); ++f) {
        if (tips[mesh.face_nodes[f][0]] != tip.node || tips[mesh.face_nodes[f][1]] != tip.node) continue;
        EXPECT_NEAR(answer.flux[f], flow.flux(mesh, f), 1e-12) << f;
        ++(test::is_outer(mesh, f) ? walls : inner);
        if (!test::is_outer(mesh, f)) continue;
        // A point of the wall, a little inside the rock: the function has its cut along the fracture.
        const Point center = mesh.face_center[f] - 1e-14 * mesh.face_normal[f];
        EXPECT_NEAR(answer.trace[f], flow.potential(center, 0).real(), 1e-8) << f;
      }
      EXPECT_GT(inner, 30);
      EXPECT_GE(walls, 4);
    }
  }
}

TEST(TipFlow, NeedsEvenIsotropicRockAndEnoughCells) {
  const TipCase tip = slanted(test::unstructured(0.05));
  const std::vector<int> cells = cells_around_tips(tip.mesh, ends_nearby(tip.mesh)).at(tip.node);
  std::vector<Tensor> rock(tip.mesh.cell_count(), mobility * Tensor::Identity());
  EXPECT_TRUE(TipFlow::find(tip.mesh, tip.node, cells, rock));
  EXPECT_FALSE(TipFlow::find(tip.mesh, tip.node, {cells.begin(), cells.begin() + 5}, rock));
  rock[cells[0]] *= 2;
  EXPECT_FALSE(TipFlow::find(tip.mesh, tip.node, cells, rock));
  Tensor layered = mobility * Tensor::Identity();
  layered(1, 1) = 1;
  EXPECT_FALSE(TipFlow::find(tip.mesh, tip.node, cells, std::vector<Tensor>(tip.mesh.cell_count(), layered)));
}

}  // namespace
}  // namespace sprekk::matrix_flow
