// Flux discretizations in space against flows that are known.
#include <gtest/gtest.h>

#include "components/matrix_flow/mpfa/mpfa.hpp"
#include "components/matrix_flow/rt0/rt0.hpp"
#include "components/matrix_flow/tpfa/tpfa.hpp"
#include "tests/space/flux_cases.hpp"

namespace sprekk {
namespace {

using test::Bend;
using test::Bodies;
using test::ExactFlow;
using test::Given;

constexpr double rounding = 1e-10;

ExactFlow linear_flow(const Tensor& mobility) {
  const Point slope(1.3, -0.7, 2.1);
  return {.pressure = [=](const Point& x) { return 0.4 + slope.dot(x); },
          .velocity = [=](const Point&) { return Point(-(mobility * slope)); }};
}

void expect_exact(const Mesh& mesh, const FluxOperators& operators, const std::vector<FlowCondition>& conditions,
                  const ExactFlow& flow) {
  ASSERT_EQ(operators.blended_nodes.sum(), 0);
  const Given given(mesh, conditions, flow);
  Vector pressure(mesh.cell_count()), of_faces(mesh.face_count());
  for (int c = 0; c < mesh.cell_count(); ++c) pressure[c] = flow.pressure(mesh.cell_center[c]);
  for (int f = 0; f < mesh.face_count(); ++f) of_faces[f] = flow.pressure(mesh.face_center[f]);
  Vector fluxes =
      operators.flux_cell * pressure + operators.flux_boundary * given.values + operators.flux_change * given.changes;
  Vector traces = operators.trace_cell * pressure + operators.trace_boundary * given.values +
                  operators.trace_change * given.changes;
  if (const FacePressureOperators& faces = operators.faces; faces.flux.rows() > 0) {
    fluxes += faces.flux * of_faces;
    traces += faces.trace * of_faces;
    const Vector sums =
        faces.continuity_cell * pressure + faces.continuity_face * of_faces + faces.continuity_boundary * given.values;
    ASSERT_LT(sums.lpNorm<Eigen::Infinity>(), rounding);
  }
  for (int f = 0; f < mesh.face_count(); ++f) {
    ASSERT_NEAR(fluxes[f], test::flux_through(mesh, f, flow), rounding) << f;
    if (mesh.face_cells[f][1] == none) {
      ASSERT_NEAR(traces[f], flow.pressure(mesh.face_center[f]), rounding) << f;
    }
  }
}

/// How far the solved flow is from a known one in cells and through faces, and how much of it is not conserved.
void expect_solved(const Mesh& mesh, const FluxOperators& operators, const std::vector<FlowCondition>& conditions,
                   const ExactFlow& flow) {
  const test::Solved solved = test::solve(mesh, operators, Given(mesh, conditions, flow), flow.source);
  for (int c = 0; c < mesh.cell_count(); ++c) {
    ASSERT_NEAR(solved.pressure[c], flow.pressure(mesh.cell_center[c]), rounding) << c;
    double outflow = 0;
    for (const int f : mesh.cell_faces[c]) outflow += (mesh.face_cells[f][0] == c ? 1 : -1) * solved.fluxes[f];
    ASSERT_NEAR(outflow, 0, rounding) << c;
  }
  for (int f = 0; f < mesh.face_count(); ++f)
    ASSERT_NEAR(solved.fluxes[f], test::flux_through(mesh, f, flow), rounding) << f;
}

class Fluxes : public testing::TestWithParam<std::tuple<Bodies, Bend, bool>> {};
INSTANTIATE_TEST_SUITE_P(Boxes, Fluxes,
                         testing::Combine(testing::Values(Bodies::hexahedra, Bodies::wedges, Bodies::tetrahedra,
                                                          Bodies::hexahedra_and_wedges),
                                          testing::Values(Bend::none, Bend::free_nodes, Bend::all), testing::Bool()));

using Discretize = FluxOperators (*)(const Mesh&, const std::vector<Tensor>&, const std::vector<FlowCondition>&,
                                     const std::vector<char>&);

void expect_linear_exact(const std::tuple<Bodies, Bend, bool>& box, Discretize discretize) {
  const auto& [bodies, bend, has_fractures] = box;
  const Mesh mesh = test::bent_box(4, bodies, bend, has_fractures);
  const auto conditions = test::mixed_conditions(mesh);
  const ExactFlow flow = linear_flow(test::some_tensor());
  const FluxOperators operators =
      discretize(mesh, std::vector<Tensor>(mesh.cell_count(), test::some_tensor()), conditions, {});
  expect_exact(mesh, operators, conditions, flow);
  expect_solved(mesh, operators, conditions, flow);
}

TEST_P(Fluxes, MpfaIsExactForLinearPressures) { expect_linear_exact(GetParam(), matrix_flow::discretize_mpfa); }
TEST_P(Fluxes, Rt0IsExactForLinearPressures) { expect_linear_exact(GetParam(), matrix_flow::discretize_rt0); }

TEST(FluxesInSpace, TpfaIsExactWhereThePermeabilityIsOrthogonal) {
  const Mesh mesh = test::bent_box(5, Bodies::hexahedra, Bend::none, true);
  const Tensor mobility = Point(2, 0.3, 5).asDiagonal();
  const auto conditions = test::mixed_conditions(mesh);
  const FluxOperators operators =
      matrix_flow::discretize_tpfa(mesh, std::vector<Tensor>(mesh.cell_count(), mobility), conditions);
  expect_exact(mesh, operators, conditions, linear_flow(mobility));
  expect_solved(mesh, operators, conditions, linear_flow(mobility));
}

TEST(FluxesInSpace, ConvergeOnUnevenTetrahedra) {
  const Tensor mobility = test::some_tensor();
  const ExactFlow flow{
      .pressure = [](const Point& x) { return std::sin(2 * x[0]) * std::cos(2 * x[1]) * std::exp(x[2]) + x[0] * x[2]; },
      .velocity =
          [=](const Point& x) {
            const double s = std::sin(2 * x[0]), c = std::cos(2 * x[0]), e = std::exp(x[2]);
            const double sy = std::sin(2 * x[1]), cy = std::cos(2 * x[1]);
            return Point(-(mobility * Point(2 * c * cy * e + x[2], -2 * s * sy * e, s * cy * e + x[0])));
          },
      .source =
          [=](const Point& x) {
            const double s = std::sin(2 * x[0]), c = std::cos(2 * x[0]), e = std::exp(x[2]);
            const double sy = std::sin(2 * x[1]), cy = std::cos(2 * x[1]);
            Tensor second;
            second << -4 * s * cy, -4 * c * sy, 2 * c * cy, -4 * c * sy, -4 * s * cy, -2 * s * sy, 2 * c * cy,
                -2 * s * sy, s * cy;
            second *= e;
            second(0, 2) += 1;
            second(2, 0) += 1;
            return -mobility.cwiseProduct(second).sum();
          }};
  std::array<double, 2> of_pressure{}, of_fluxes{};
  for (int level = 0; level < 2; ++level) {
    const Mesh mesh = test::bent_box(level == 0 ? 4 : 8, Bodies::tetrahedra, Bend::free_nodes, false);
    const auto conditions = test::given_pressures(mesh);
    const test::Solved solved = test::solve(
        mesh, matrix_flow::discretize_mpfa(mesh, std::vector<Tensor>(mesh.cell_count(), mobility), conditions),
        Given(mesh, conditions, flow), flow.source);
    for (int c = 0; c < mesh.cell_count(); ++c)
      of_pressure[level] += mesh.cell_measure[c] * std::pow(solved.pressure[c] - flow.pressure(mesh.cell_center[c]), 2);
    double all = 0;
    for (int f = 0; f < mesh.face_count(); ++f) {
      const double weight = std::pow(mesh.face_measure[f], 1.5);
      of_fluxes[level] +=
          weight * std::pow((solved.fluxes[f] - test::flux_through(mesh, f, flow)) / mesh.face_measure[f], 2);
      all += weight;
    }
    of_fluxes[level] /= all;
  }
  EXPECT_GT(0.5 * std::log2(of_pressure[0] / of_pressure[1]), 1.9);
  EXPECT_GT(0.5 * std::log2(of_fluxes[0] / of_fluxes[1]), 0.9);
}

/// A box whose halves x < 1/2 and x > 1/2 meet at a plane; all nodes that are on no side are moved, those on the plane
/// along it.
RawMesh two_halves(Bodies bodies) {
  test::BoxMesh box({4, 4, 4}, bodies);
  std::mt19937 random(2);
  std::uniform_real_distribution<double> amount(-0.15, 0.15);
  std::vector<char> is_between;
  for (const Point& node : box.raw.nodes) is_between.push_back(node[0] == 2);
  box.move_free_nodes([&] {
    const double x = amount(random), y = amount(random);
    return Point(x, y, amount(random));
  });
  for (std::size_t i = 0; i < is_between.size(); ++i) {
    if (is_between[i]) box.raw.nodes[i][0] = 2;
    box.raw.nodes[i] /= 4;
  }
  return box.raw;
}

class FluxesOf : public testing::TestWithParam<Bodies> {};
INSTANTIATE_TEST_SUITE_P(Bodies, FluxesOf,
                         testing::Values(Bodies::hexahedra, Bodies::wedges, Bodies::tetrahedra,
                                         Bodies::hexahedra_and_wedges));

TEST_P(FluxesOf, AreExactWhereTenMagnitudesMeet) {
  const Mesh mesh = build_mesh(two_halves(GetParam()));
  constexpr double tight = 1e-10;
  const auto is_tight = [](const Point& x) { return x[0] > 0.5; };
  const ExactFlow flow{
      .pressure = [=](const Point& x) { return (x[0] - 0.5) * (is_tight(x) ? 1 : tight) + 0.3 * x[1]; },
      .velocity = [=](const Point& x) { return Point(-tight, is_tight(x) ? -0.3 * tight : -0.3, 0); }};
  std::vector<Tensor> mobility;
  for (const Point& center : mesh.cell_center) mobility.push_back((is_tight(center) ? tight : 1) * Tensor::Identity());
  const auto conditions = test::given_pressures(mesh);
  const Given given(mesh, conditions, flow);
  const FluxOperators operators = matrix_flow::discretize_mpfa(mesh, mobility, conditions);
  const test::Solved solved = test::solve(mesh, operators, given, flow.source);
  for (int c = 0; c < mesh.cell_count(); ++c)
    EXPECT_NEAR(solved.pressure[c], flow.pressure(mesh.cell_center[c]), 1e-9) << c;
  for (int f = 0; f < mesh.face_count(); ++f) {
    const bool is_beside_tight = is_tight(mesh.cell_center[mesh.face_cells[f][0]]) && mesh.face_cells[f][1] != none &&
                                 is_tight(mesh.cell_center[mesh.face_cells[f][1]]);
    if (!is_beside_tight) continue;  // what flows along the other half is ten magnitudes larger
    EXPECT_NEAR(solved.fluxes[f], test::flux_through(mesh, f, flow), 1e-9 * tight) << f;
  }
}

/// What flows out of each cell by the pressures of all: it does not depend on how faces are numbered.
Eigen::MatrixXd outflow(const RawMesh& raw, const Tensor& mobility) {
  const Mesh mesh = build_mesh(raw);
  const FluxOperators operators = matrix_flow::discretize_mpfa(mesh, std::vector<Tensor>(mesh.cell_count(), mobility),
                                                               test::mixed_conditions(mesh));
  Eigen::MatrixXd sums = Eigen::MatrixXd::Zero(mesh.cell_count(), mesh.cell_count());
  for (int f = 0; f < mesh.face_count(); ++f)
    for (SparseMatrix::InnerIterator entry(operators.flux_cell, f); entry; ++entry) {
      const auto [cell, other] = mesh.face_cells[f];
      sums(cell, entry.col()) += entry.value();
      if (other != none) sums(other, entry.col()) -= entry.value();
    }
  return sums;
}

TEST_P(FluxesOf, TurnWithTheRock) {
  RawMesh raw = two_halves(GetParam());
  const Eigen::MatrixXd before = outflow(raw, test::some_tensor());
  const Tensor turn = Eigen::AngleAxisd(0.8, Point(1, -2, 0.5).normalized()).toRotationMatrix();
  for (Point& node : raw.nodes) node = turn * node + Point(3, 1, -2);
  const Eigen::MatrixXd turned = outflow(raw, turn * test::some_tensor() * turn.transpose());
  EXPECT_LT((turned - before).lpNorm<Eigen::Infinity>(), 1e-12 * before.lpNorm<Eigen::Infinity>() * before.rows());
}

TEST_P(FluxesOf, AreMirroredWithTheRock) {
  RawMesh raw = two_halves(GetParam());
  const Eigen::MatrixXd before = outflow(raw, test::some_tensor());
  const Tensor mirror = Point(1, 1, -1).asDiagonal();
  for (Point& node : raw.nodes) node = mirror * node;
  const Eigen::MatrixXd mirrored = outflow(raw, mirror * test::some_tensor() * mirror);
  EXPECT_LT((mirrored - before).lpNorm<Eigen::Infinity>(), 1e-12 * before.lpNorm<Eigen::Infinity>() * before.rows());
}

TEST_P(FluxesOf, ChangeLittleWithTheMesh) {
  RawMesh raw = two_halves(GetParam());
  const Eigen::MatrixXd before = outflow(raw, test::some_tensor());
  for (std::size_t i = 0; i < raw.nodes.size(); ++i) raw.nodes[i] *= 1 + (i % 2 == 0 ? 1e-9 : -1e-9);
  EXPECT_LT((outflow(raw, test::some_tensor()) - before).lpNorm<Eigen::Infinity>(),
            1e-6 * before.lpNorm<Eigen::Infinity>());
}

}  // namespace
}  // namespace sprekk
