// Fluxes near the rim of a fracture, against the flow across it.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <complex>

#include "components/matrix_flow/mpfa/mpfa.hpp"
#include "framework/discretization/ends_nearby.hpp"
#include "framework/discretization/nodes_around_end.hpp"
#include "framework/mesh/build_mesh.hpp"
#include "tests/space/box_mesh.hpp"

namespace sprekk::matrix_flow {
namespace {

using Complex = std::complex<double>;
using test::Bodies;
using test::BoxMesh;

constexpr int count = 6;
constexpr double mobility = 3;

/// p = Re(amount sqrt(z)) + gradient · x, with z across a rim that goes along the second axis, at x = 1/2 of a fracture
/// at z = 1/2 behind it; all of it is turned.
struct Flow {
  Tensor turn;
  Complex amount;
  Point gradient;

  Complex root(const Point& x, int side) const {
    const Point local = turn.transpose() * x - Point(0.5, 0, 0.5);
    const Complex z(local[0], local[2]), root = std::sqrt(z);
    return side != 0 && local[0] < 0 && std::abs(local[2]) < 1e-12 ? Complex(0, side) * std::abs(root) : root;
  }
  double pressure(const Point& x, int side) const { return (amount * root(x, side)).real() + gradient.dot(x); }

  /// Out of the first cell: minus the circulation of the stream function along the rim, whose mean over an edge is
  /// found by steps that are small at its ends.
  double flux(const Mesh& mesh, int face) const {
    const Point center = turn.transpose() * mesh.cell_center[mesh.face_cells[face][0]];
    const bool is_wall = mesh.face_fracture_cell[face] != none;
    const int side = is_wall                                                ? (center[2] > 0.5 ? 1 : -1)
                     : (turn.transpose() * mesh.face_center[face])[2] > 0.5 ? 1
                                                                            : -1;
    const FaceNodes& nodes = mesh.face_nodes[face];
    double circulation = 0;
    for (int k = 0; k < nodes.size(); ++k) {
      const Point &from = mesh.nodes[nodes[k]], &to = mesh.nodes[nodes.after(k)];
      constexpr int steps = 500;
      double mean = 0;
      for (int i = 0; i < steps; ++i) {
        const double u = (i + 0.5) / steps, s = u * u * u * (10 - 15 * u + 6 * u * u),
                     ds = 30 * u * u * (1 - u) * (1 - u);
        mean += ds / steps * (amount * root(from + s * (to - from), side)).imag();
      }
      // Ahead, left and -y are right-handed.
      circulation -= mean * turn.col(1).dot(to - from);
    }
    return -mobility * (circulation + gradient.dot(mesh.face_normal[face]) * mesh.face_measure[face]);
  }
};

Mesh with_rim(Bodies bodies, const Tensor& turn, bool is_bent) {
  BoxMesh box({count, count, count}, bodies);
  box.add_fracture({"behind", 2, count / 2, {0, 0}, {count / 2, count}});
  if (is_bent) {
    int k = 0;
    box.move_free_nodes([&] {
      ++k;
      return Point(0.12 * std::sin(7 * k), 0.12 * std::sin(11 * k), 0.12 * std::cos(5 * k));
    });
  }
  for (Point& node : box.raw.nodes) node = turn * node / count;
  return build_mesh(box.raw);
}

void expect_exact(Bodies bodies, bool is_bent) {
  const Tensor turn = Eigen::AngleAxisd(0.7, Point(1, -2, 3).normalized()).toRotationMatrix();
  const Mesh mesh = with_rim(bodies, turn, is_bent);
  const std::vector<int> ends = ends_nearby(mesh);
  const std::vector<Tensor> rock(mesh.cell_count(), mobility * Tensor::Identity());
  for (const Complex amount : {Complex(0.7, 0), Complex(0, 0.7), Complex(-0.3, 0.8)}) {
    const Flow flow{turn, amount, Point(-0.4, 0.9, 0.3)};
    std::vector<FlowCondition> conditions(mesh.face_count(), FlowCondition::none);
    Vector p(mesh.cell_count()), b = Vector::Zero(mesh.face_count());
    for (int f = 0; f < mesh.face_count(); ++f)
      if (mesh.face_cells[f][1] == none) {
        conditions[f] = FlowCondition::flux;
        b[f] = flow.flux(mesh, f);
      }
    for (int c = 0; c < mesh.cell_count(); ++c) p[c] = flow.pressure(mesh.cell_center[c], 0);
    const FluxOperators operators = discretize_mpfa(mesh, rock, conditions);
    const Vector flux = operators.flux_cell * p + operators.flux_boundary * b,
                 trace = operators.trace_cell * p + operators.trace_boundary * b;
    int inner = 0, walls = 0;
    for (int f = 0; f < mesh.face_count(); ++f) {
      if (std::ranges::any_of(mesh.face_nodes[f], [&](int node) { return ends[node] == none; })) continue;
      if (mesh.face_cells[f][1] != none) {
        EXPECT_NEAR(flux[f], flow.flux(mesh, f), 1e-8) << f;
        ++inner;
      } else if (const int wall = mesh.face_fracture_cell[f]; wall != none) {
        const int side = (turn.transpose() * mesh.cell_center[mesh.face_cells[f][0]])[2] > 0.5 ? 1 : -1;
        EXPECT_NEAR(trace[f], flow.pressure(mesh.face_center[f], side), 1e-8) << f;
        ++walls;
      }
    }
    EXPECT_GT(inner, 200);
    EXPECT_GE(walls, 4 * count);
  }
}

TEST(RimFlow, FluxesNearAStraightRimAreExactForTheFlowAcrossItBesideLinearPressures) {
  for (const Bodies bodies : {Bodies::tetrahedra, Bodies::wedges, Bodies::hexahedra}) {
    SCOPED_TRACE(static_cast<int>(bodies));
    expect_exact(bodies, false);
  }
  expect_exact(Bodies::tetrahedra, true);
}

TEST(RimFlow, NodesOfARimAreEndsButForItsCornersAndWhereItMeetsASideAtAnAngle) {
  BoxMesh box({count, count, count}, Bodies::hexahedra);
  box.add_fracture({"apart", 2, count / 2, {1, 0}, {count - 1, count - 2}});
  const Mesh straight = build_mesh(box.raw);
  const auto ends = [](const Mesh& mesh) {
    int found = 0;
    for (int node = 0; node < mesh.node_count(); ++node) found += is_fracture_end(mesh, node);
    return found;
  };
  // Along x, count - 1 nodes less two corners; along y, count - 2 on either side, which begin on the front.
  EXPECT_EQ(ends(straight), (count - 3) + 2 * (count - 2));
  for (Point& node : box.raw.nodes) node[0] += 0.3 * node[1];  // the rims meet the front at 73 degrees
  EXPECT_EQ(ends(build_mesh(box.raw)), (count - 3) + 2 * (count - 3));
}

}  // namespace
}  // namespace sprekk::matrix_flow
