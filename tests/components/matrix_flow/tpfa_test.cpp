#include <cmath>

#include "components/matrix_flow/tpfa/tpfa.hpp"

#include <gtest/gtest.h>

#include "tests/components/meshes.hpp"

namespace sprekk::matrix_flow {
namespace {

/// Equilateral triangles, on which two points suffice: a rhombus of n × n cells of edge length 1.
Mesh equilateral(int n) {
  RawMesh raw;
  raw.region_names = {"rock"};
  raw.side_names = {"edge"};
  const auto node = [n](int i, int j) { return i + (n + 1) * j; };
  for (int j = 0; j <= n; ++j)
    for (int i = 0; i <= n; ++i) raw.nodes.emplace_back(i + 0.5 * j, std::sqrt(0.75) * j);
  for (int j = 0; j < n; ++j)
    for (int i = 0; i < n; ++i) {
      raw.cells.push_back({node(i, j), node(i + 1, j), node(i, j + 1)});
      raw.cells.push_back({node(i + 1, j), node(i + 1, j + 1), node(i, j + 1)});
    }
  raw.regions.assign(raw.cells.size(), 0);
  for (int i = 0; i < n; ++i) {
    raw.boundary_faces.push_back({{node(0, i), node(0, i + 1)}, 0});
    raw.boundary_faces.push_back({{node(n, i), node(n, i + 1)}, 0});
    raw.boundary_faces.push_back({{node(i, 0), node(i + 1, 0)}, 0});
    raw.boundary_faces.push_back({{node(i, n), node(i + 1, n)}, 0});
  }
  return build_mesh(raw);
}

std::vector<FlowCondition> mixed_conditions(const Mesh& mesh) {
  std::vector<FlowCondition> conditions(mesh.face_count(), FlowCondition::none);
  for (int f = 0; f < mesh.face_count(); ++f)
    if (test::is_outer(mesh, f)) conditions[f] = f % 2 == 0 ? FlowCondition::pressure : FlowCondition::flux;
  return conditions;
}

TEST(Tpfa, IsExactOnEquilateralTriangles) {
  const Mesh mesh = equilateral(5);
  const Point gradient(0.8, -1.7);
  const double mobility = 0.3;
  const auto conditions = mixed_conditions(mesh);
  const auto operators =
      discretize_tpfa(mesh, std::vector<Tensor>(mesh.cell_count(), mobility * Tensor::Identity()), conditions);
  const auto flux = [&](int f) { return -mobility * test::face_vector(mesh, f).dot(gradient); };
  Vector p(mesh.cell_count()), b = Vector::Zero(mesh.face_count());
  for (int c = 0; c < mesh.cell_count(); ++c) p[c] = gradient.dot(mesh.cell_center[c]);
  for (int f = 0; f < mesh.face_count(); ++f)
    b[f] = conditions[f] == FlowCondition::pressure ? gradient.dot(mesh.face_center[f]) : flux(f);
  const Vector fluxes = operators.flux_cell * p + operators.flux_boundary * b;
  const Vector traces = operators.trace_cell * p + operators.trace_boundary * b;
  for (int f = 0; f < mesh.face_count(); ++f) {
    // On the boundary the centre of a face lies straight above that of its cell, so that these rows are exact too.
    EXPECT_NEAR(fluxes[f], flux(f), 1e-13);
    EXPECT_NEAR(traces[f], test::is_outer(mesh, f) ? gradient.dot(mesh.face_center[f]) : 0, 1e-13);
  }
}

TEST(Tpfa, IsMonotoneForEveryTensorAndMesh) {
  // The balance of every cell has a positive diagonal, negative off-diagonals and no negative row sum: an M-matrix.
  const Mesh mesh = test::fractured_square();
  Tensor mobility;
  mobility << 100, 9.9, 9.9, 1;
  const auto operators =
      discretize_tpfa(mesh, std::vector<Tensor>(mesh.cell_count(), mobility), mixed_conditions(mesh));
  const SparseMatrix balance = test::divergence(mesh, 1) * operators.flux_cell;
  for (int row = 0; row < balance.rows(); ++row) {
    double sum = 0, diagonal = 0;
    for (SparseMatrix::InnerIterator entry(balance, row); entry; ++entry) {
      sum += entry.value();
      if (entry.col() == row)
        diagonal = entry.value();
      else
        EXPECT_LT(entry.value(), 0);
    }
    EXPECT_GT(diagonal, 0);
    EXPECT_GT(sum, -1e-12 * diagonal);
  }
}

TEST(Tpfa, HandlesLayersWithAContrastOfTenOrders) {
  const Mesh mesh = equilateral(6);
  std::vector<Tensor> mobility(mesh.cell_count(), Tensor::Identity());
  const double interface = 3 * std::sqrt(0.75);
  for (int c = 0; c < mesh.cell_count(); ++c)
    if (mesh.cell_center[c][1] < interface) mobility[c] *= 1e10;
  const auto pressure = [&](const Point& x) { return (x[1] - interface) * (x[1] < interface ? 1e-10 : 1); };
  const auto conditions = mixed_conditions(mesh);
  const auto operators = discretize_tpfa(mesh, mobility, conditions);
  Vector p(mesh.cell_count()), b = Vector::Zero(mesh.face_count());
  for (int c = 0; c < mesh.cell_count(); ++c) p[c] = pressure(mesh.cell_center[c]);
  for (int f = 0; f < mesh.face_count(); ++f)
    b[f] = conditions[f] == FlowCondition::pressure ? pressure(mesh.face_center[f]) : -test::face_vector(mesh, f)[1];
  const Vector fluxes = operators.flux_cell * p + operators.flux_boundary * b;
  for (int f = 0; f < mesh.face_count(); ++f) EXPECT_NEAR(fluxes[f], -test::face_vector(mesh, f)[1], 1e-12);
}

}  // namespace
}  // namespace sprekk::matrix_flow
