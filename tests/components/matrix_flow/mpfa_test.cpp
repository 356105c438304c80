#include "components/matrix_flow/mpfa/mpfa.hpp"

#include <gtest/gtest.h>

#include <functional>

#include "tests/components/matrix_flow/flow_set_ups.hpp"

namespace sprekk::matrix_flow {
namespace {

using test::is_lower;
using test::is_outer;
using test::mixed_conditions;

template <class Pressure, class Flux>
Vector boundary_values(const Mesh& mesh, const std::vector<FlowCondition>& conditions, Pressure pressure, Flux flux) {
  Vector values = Vector::Zero(mesh.face_count());
  for (int f = 0; f < mesh.face_count(); ++f) {
    if (conditions[f] == FlowCondition::pressure) values[f] = pressure(mesh.face_center[f]);
    if (conditions[f] == FlowCondition::flux) values[f] = flux(f);
  }
  return values;
}

/// Of a prescribed pressure along the faces.
template <class Pressure>
Vector boundary_changes(const Mesh& mesh, Pressure pressure) {
  Vector changes = Vector::Zero(mesh.face_count());
  for (int f = 0; f < mesh.face_count(); ++f)
    changes[f] = pressure(mesh.nodes[mesh.face_nodes[f][1]]) - pressure(mesh.nodes[mesh.face_nodes[f][0]]);
  return changes;
}

Vector at_centers(const Mesh& mesh, const std::function<double(const Point&)>& function) {
  Vector values(mesh.cell_count());
  for (int c = 0; c < mesh.cell_count(); ++c) values[c] = function(mesh.cell_center[c]);
  return values;
}

TEST(Mpfa, IsExactForLinearPressuresInAnisotropicRock) {
  Tensor mobility;
  mobility << 3, 1.2, 1.2, 0.7;
  const Point gradient(1.3, -0.4);
  const auto pressure = [&](const Point& x) { return 2 + gradient.dot(x); };
  for (const Mesh& mesh : test::various_meshes()) {
    const auto flux = [&](int f) { return -test::face_vector(mesh, f).dot(mobility * gradient); };
    const auto conditions = mixed_conditions(mesh);
    const auto operators = discretize_mpfa(mesh, std::vector<Tensor>(mesh.cell_count(), mobility), conditions);
    const Vector p = at_centers(mesh, pressure), b = boundary_values(mesh, conditions, pressure, flux);
    const Vector s = boundary_changes(mesh, pressure);
    const Vector fluxes = operators.flux_cell * p + operators.flux_boundary * b + operators.flux_change * s;
    const Vector traces = operators.trace_cell * p + operators.trace_boundary * b + operators.trace_change * s;
    for (int f = 0; f < mesh.face_count(); ++f) {
      EXPECT_NEAR(fluxes[f], flux(f), 1e-12);
      EXPECT_NEAR(traces[f], is_outer(mesh, f) ? pressure(mesh.face_center[f]) : 0, 1e-12);
    }
  }
}

/// Layers of mobility k below and 1 above y = 1/2. The pressure a x + b y / k has the flux (-a k, -b).
class MpfaLayers : public testing::TestWithParam<double> {};

TEST_P(MpfaLayers, AreExact) {
  const double contrast = GetParam();
  const Mesh mesh = test::two_layers();
  const std::vector<Tensor> mobility = test::mobility_of_layers(mesh, contrast);

  const auto pressure = [&](const Point& x) { return is_lower(x) ? (x[1] - 0.5) / contrast : x[1] - 0.5; };
  const auto flux = [&](int f) { return -test::face_vector(mesh, f)[1]; };
  const auto conditions = mixed_conditions(mesh);
  const auto operators = discretize_mpfa(mesh, mobility, conditions);
  const Vector p = at_centers(mesh, pressure), b = boundary_values(mesh, conditions, pressure, flux);
  const Vector s = boundary_changes(mesh, pressure);
  const Vector fluxes = operators.flux_cell * p + operators.flux_boundary * b + operators.flux_change * s;
  const Vector traces = operators.trace_cell * p + operators.trace_boundary * b + operators.trace_change * s;
  // Pressures reach 1/2 above and 1 / (2 contrast) below the interface, so that fluxes are of the order of 1 in both.
  for (int f = 0; f < mesh.face_count(); ++f) {
    EXPECT_NEAR(fluxes[f], flux(f), 1e-11) << "face at " << mesh.face_center[f].transpose();
    EXPECT_NEAR(traces[f], is_outer(mesh, f) ? pressure(mesh.face_center[f]) : 0, 1e-12 * std::max(1.0, 1 / contrast));
  }
}

INSTANTIATE_TEST_SUITE_P(Contrasts, MpfaLayers, testing::Values(1e-10, 1e-3, 1e3, 1e10));

TEST(Mpfa, AlongLayersIsExact) {
  // Flow along layers: the same gradient in both.
  const Mesh mesh = generate_mesh(test::box(1, 1), test::structured(8, 8, 0));
  std::vector<Tensor> mobility(mesh.cell_count(), Tensor::Identity());
  for (int c = 0; c < mesh.cell_count(); ++c)
    if (mesh.cell_center[c][1] < 0.5) mobility[c] *= 1e-10;
  const auto pressure = [](const Point& x) { return x[0]; };
  const auto flux = [&](int f) { return -test::face_vector(mesh, f)[0] * mobility[mesh.face_cells[f][0]](0, 0); };
  const auto conditions = mixed_conditions(mesh);
  const auto operators = discretize_mpfa(mesh, mobility, conditions);
  const Vector p = at_centers(mesh, pressure), b = boundary_values(mesh, conditions, pressure, flux);
  const Vector fluxes =
      operators.flux_cell * p + operators.flux_boundary * b + operators.flux_change * boundary_changes(mesh, pressure);
  for (int f = 0; f < mesh.face_count(); ++f) {
    const double scale = mobility[mesh.face_cells[f][0]](0, 0);
    EXPECT_NEAR(fluxes[f], flux(f), 1e-12 * scale);
  }
}

TEST(Mpfa, PrescribedFluxesAreKeptToTheLastDigit) {
  const Mesh mesh = test::fractured_square();
  const auto conditions = mixed_conditions(mesh);
  const auto operators =
      discretize_mpfa(mesh, std::vector<Tensor>(mesh.cell_count(), 1e-13 * Tensor::Identity()), conditions);
  const Vector p = Vector::Random(mesh.cell_count()) * 1e7, b = Vector::Random(mesh.face_count());
  const Vector fluxes = operators.flux_cell * p + operators.flux_boundary * b;
  for (int f = 0; f < mesh.face_count(); ++f)
    if (conditions[f] == FlowCondition::flux) {
      EXPECT_EQ(fluxes[f], b[f]);
    }
}

TEST(Mpfa, ChosenNodesGiveTheSameRows) {
  const Mesh mesh = test::fractured_square();
  const auto conditions = mixed_conditions(mesh);
  const std::vector<Tensor> mobility(mesh.cell_count(), Tensor::Identity());
  std::vector<char> nodes(mesh.node_count());
  for (int n = 0; n < mesh.node_count(); ++n) nodes[n] = mesh.nodes[n][0] < 0.6;
  const auto all = discretize_mpfa(mesh, mobility, conditions);
  const auto some = discretize_mpfa(mesh, mobility, conditions, nodes);
  int compared = 0;
  for (int f = 0; f < mesh.face_count(); ++f) {
    if (!nodes[mesh.face_nodes[f][0]] || !nodes[mesh.face_nodes[f][1]]) continue;
    ++compared;
    EXPECT_EQ(test::row_difference(all.flux_cell, some.flux_cell, f), 0);
    EXPECT_EQ(test::row_difference(all.flux_boundary, some.flux_boundary, f), 0);
    EXPECT_EQ(test::row_difference(all.flux_change, some.flux_change, f), 0);
    EXPECT_EQ(test::row_difference(all.trace_change, some.trace_change, f), 0);
    EXPECT_EQ(test::row_difference(all.trace_cell, some.trace_cell, f), 0);
    EXPECT_EQ(test::row_difference(all.trace_boundary, some.trace_boundary, f), 0);
  }
  EXPECT_GT(compared, mesh.face_count() / 3);
}

TEST(Mpfa, RefusesConditionsThatDoNotFitTheMesh) {
  const Mesh mesh = test::square_with_single_corners(2);
  const std::vector<Tensor> mobility(mesh.cell_count(), Tensor::Identity());
  EXPECT_THROW(discretize_mpfa(mesh, {}, mixed_conditions(mesh)), std::invalid_argument);
  EXPECT_THROW(discretize_mpfa(mesh, mobility, {}), std::invalid_argument);
  EXPECT_THROW(discretize_mpfa(mesh, mobility, std::vector(mesh.face_count(), FlowCondition::none)),
               std::invalid_argument);
  EXPECT_THROW(discretize_mpfa(mesh, mobility, std::vector(mesh.face_count(), FlowCondition::flux)),
               std::invalid_argument);
  EXPECT_THROW(discretize_mpfa(mesh, mobility, mixed_conditions(mesh), {1}), std::invalid_argument);
  const std::vector<Tensor> zero(mesh.cell_count(), Tensor::Zero());
  EXPECT_THROW(discretize_mpfa(mesh, zero, mixed_conditions(mesh)), std::runtime_error);
}

}  // namespace
}  // namespace sprekk::matrix_flow
