// Pressures that leave the bounds of their surroundings are found, and no others are.
#include "components/capabilities/overshoots.hpp"

#include <gtest/gtest.h>

#include <Eigen/SparseLU>
#include <cmath>
#include <functional>

#include "components/matrix_flow/mpfa/mpfa.hpp"
#include "components/matrix_flow/tpfa/tpfa.hpp"
#include "tests/components/meshes.hpp"

namespace sprekk::matrix_flow {
namespace {

struct Scene {
  Mesh mesh;
  Tensor mobility;
  std::function<double(const Point&)> initial, left, source = [](const Point&) { return 0.0; };
  double right = 0, dt = 1, storage = 1;
};

Tensor tensor(double ratio, double degrees) {
  const double angle = degrees * std::acos(-1.0) / 180;
  const Point along(std::cos(angle), std::sin(angle)), across(-along.y(), along.x());
  return along * along.transpose() + ratio * across * across.transpose();
}

using Discretization = FluxOperators (*)(const Mesh&, const std::vector<Tensor>&, const std::vector<FlowCondition>&,
                                         const std::vector<char>&);

/// After one step of backward Euler; `bounds`: of the pressures.
Overshoots after_a_step(const Scene& scene, Discretization discretize, std::array<double, 2>* bounds = nullptr) {
  const Mesh& mesh = scene.mesh;
  std::vector<FlowCondition> conditions(mesh.face_count(), FlowCondition::none);
  Vector values = Vector::Zero(mesh.face_count()), changes = values;
  for (int f = 0; f < mesh.face_count(); ++f) {
    if (!test::is_outer(mesh, f)) continue;
    conditions[f] = FlowCondition::flux;
    const double x = mesh.face_center[f].x();
    if (test::is_wall(mesh, f) || (x > 1e-9 && x < 1 - 1e-9)) continue;
    conditions[f] = FlowCondition::pressure;
    values[f] = x < 0.5 ? scene.left(mesh.face_center[f]) : scene.right;
    if (x < 0.5)
      changes[f] = scene.left(mesh.nodes[mesh.face_nodes[f][1]]) - scene.left(mesh.nodes[mesh.face_nodes[f][0]]);
  }
  const FluxOperators operators =
      discretize(mesh, std::vector<Tensor>(mesh.cell_count(), scene.mobility), conditions, {});
  const SparseMatrix divergence = test::divergence(mesh, 1);
  Vector capacity(mesh.cell_count()), before(mesh.cell_count()), source(mesh.cell_count());
  for (int c = 0; c < mesh.cell_count(); ++c) {
    capacity[c] = scene.storage * mesh.cell_measure[c];
    before[c] = scene.initial(mesh.cell_center[c]);
    source[c] = scene.dt * mesh.cell_measure[c] * scene.source(mesh.cell_center[c]);
  }
  Eigen::SparseMatrix<double> system = scene.dt * (divergence * operators.flux_cell);
  for (int c = 0; c < mesh.cell_count(); ++c) system.coeffRef(c, c) += capacity[c];
  const Vector of_sides = operators.flux_boundary * values + operators.flux_change * changes;
  Eigen::SparseLU<Eigen::SparseMatrix<double>> solver(system);
  const Vector after =
      solver.solve(Vector(capacity.cwiseProduct(before) + source - scene.dt * (divergence * of_sides)));
  const Vector fluxes = operators.flux_cell * after + of_sides;
  if (bounds) *bounds = {after.minCoeff(), after.maxCoeff()};
  return find_overshoots(
      {mesh, conditions, after, before, values, changes, fluxes, capacity, scene.dt, after.lpNorm<Eigen::Infinity>()});
}

const auto zero = [](const Point&) { return 0.0; };

TEST(Overshoots, AreCountedWhereAnisotropicRockMakesThemOnCoarseTriangles) {
  // Reference: pressures lie between 0 and 1, those of the sides and of the start.
  const auto window = [](const Point& x) { return std::abs(x.y() - 0.4) < 0.15 ? 1.0 : 0.0; };
  for (const double angle : {30.0, 67.0, 112.0}) {
    std::array<double, 2> bounds;
    const Scene scene{generate_mesh(test::box(1, 1), test::unstructured(0.12)), tensor(1e-4, angle), zero, window};
    const Overshoots found = after_a_step(scene, discretize_mpfa, &bounds);
    EXPECT_TRUE(bounds[0] < -0.02 || bounds[1] > 1.02) << angle;
    EXPECT_GT(found.cells, 0) << angle;
    EXPECT_GT(found.largest, 0.02) << angle;
    EXPECT_EQ(after_a_step(scene, discretize_tpfa).cells, 0) << angle;
  }
}

TEST(Overshoots, AreNoneInOrdinaryRock) {
  const auto rising = [](const Point& x) { return 1 + 0.5 * std::sin(5 * x.y()); };
  const auto hill = [](const Point& x) { return std::exp(-30 * (x - Point(0.5, 0.4)).squaredNorm()); };
  const auto well = [](const Point& x) { return (x - Point(0.6, 0.4)).norm() < 0.1 ? 10.0 : 0.0; };
  for (const double dt : {1e-6, 1e-4, 1e-2, 1.0, 1e4})
    for (const Mesh& mesh : {test::fractured_square(test::unstructured(0.1)), test::fractured_square(test::mixed(0.1)),
                             generate_mesh(test::box(1, 1), test::rectangles(12, 12))})
      for (const double ratio : {1.0, 0.2}) {
        EXPECT_EQ(after_a_step({mesh, tensor(ratio, 20), zero, rising, zero, 0, dt}, discretize_mpfa).cells, 0) << dt;
        EXPECT_EQ(after_a_step({mesh, tensor(ratio, 70), hill, zero, zero, 0, dt}, discretize_mpfa).cells, 0) << dt;
        EXPECT_EQ(after_a_step({mesh, tensor(ratio, 140), zero, zero, well, 0, dt}, discretize_mpfa).cells, 0) << dt;
        // A sink in a well's place, and a mean pressure far from zero.
        const auto sink = [&](const Point& x) { return -well(x); };
        const auto high = [](const Point&) { return 1e3; };
        EXPECT_EQ(after_a_step({mesh, tensor(ratio, 5), high, high, sink, 1e3, dt}, discretize_mpfa).cells, 0) << dt;
      }
}

}  // namespace
}  // namespace sprekk::matrix_flow
