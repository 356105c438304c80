#include "components/matrix_flow/ntpfa/ntpfa.hpp"

#include <gtest/gtest.h>

#include <limits>

#include <cmath>
#include <functional>

#include "components/matrix_flow/limited_fluxes.hpp"
#include "tests/components/matrix_flow/flow_set_ups.hpp"

namespace sprekk::matrix_flow {
namespace {

using test::is_lower;
using test::is_outer;
using test::mixed_conditions;

std::vector<Mesh> meshes() {
  std::vector<Mesh> all = test::various_meshes();
  all.push_back(generate_mesh(test::box(2, 1), test::rectangles(7, 5, 0.4)));
  return all;
}

/// With an exact solution, both one-sided fluxes, their mean and all traces are exact, except at no more than
/// `exceptions` faces, which the discretization has to name. Changes of prescribed pressures along faces are those of a
/// linear pressure.
void expect_exact(const Mesh& mesh, const std::vector<Tensor>& mobility,
                  const std::function<double(const Point&)>& pressure, const std::function<double(int)>& flux,
                  double tolerance, int exceptions) {
  const auto conditions = mixed_conditions(mesh);
  const FluxOperators operators = discretize_ntpfa(mesh, mobility, conditions);
  EXPECT_LE(operators.blended_nodes.nonZeros(), exceptions);
  Vector p(mesh.cell_count()), b = Vector::Zero(mesh.face_count()), s = b;
  for (int c = 0; c < mesh.cell_count(); ++c) p[c] = pressure(mesh.cell_center[c]);
  for (int f = 0; f < mesh.face_count(); ++f) {
    if (conditions[f] == FlowCondition::flux) b[f] = flux(f);
    if (conditions[f] != FlowCondition::pressure) continue;
    b[f] = pressure(mesh.face_center[f]);
    s[f] = pressure(mesh.nodes[mesh.face_nodes[f][1]]) - pressure(mesh.nodes[mesh.face_nodes[f][0]]);
  }
  const Vector common = operators.flux_cell * p + operators.flux_boundary * b + operators.flux_change * s;
  const auto side = [&](int k) -> Vector {
    const OneSidedFluxOperators& of = operators.limited[k];
    return of.cell * p + of.boundary * b + of.change * s;
  };
  const Vector limited = limit(side(0), side(1)).value;
  const Vector traces = operators.trace_cell * p + operators.trace_boundary * b + operators.trace_change * s;
  for (int f = 0; f < mesh.face_count(); ++f) {
    if (operators.blended_nodes.coeff(f, f) > 0) continue;
    EXPECT_NEAR(common[f] + limited[f], flux(f), tolerance) << "face at " << mesh.face_center[f].transpose();
    for (const int k : {0, 1}) EXPECT_NEAR(common[f] + side(k)[f], flux(f), tolerance) << k;
    EXPECT_NEAR(traces[f], is_outer(mesh, f) ? pressure(mesh.face_center[f]) : 0, tolerance);
  }
}

TEST(Ntpfa, IsExactForLinearPressuresInAnisotropicRock) {
  const Point gradient(1.3, -0.4);
  for (const double ratio : {0.2, 1e-3})
    for (const double angle : {0.3, 1.2}) {
      const Point along(std::cos(angle), std::sin(angle)), across(-along.y(), along.x());
      const Tensor mobility = along * along.transpose() + ratio * across * across.transpose();
      for (const Mesh& mesh : meshes())
        expect_exact(
            mesh, std::vector<Tensor>(mesh.cell_count(), mobility), [&](const Point& x) { return 2 + gradient.dot(x); },
            [&](int f) { return -test::face_vector(mesh, f).dot(mobility * gradient); }, 1e-10, mesh.face_count() / 20);
    }
}

/// Layers of mobility k below and 1 above y = 1/2. The pressure y / k has the flux (0, -1).
TEST(Ntpfa, IsExactAcrossLayers) {
  const Mesh mesh = test::two_layers();
  for (const double contrast : {1e-3, 0.1, 10.0, 1e3}) {
    expect_exact(
        mesh, test::mobility_of_layers(mesh, contrast),
        [&](const Point& x) { return is_lower(x) ? (x[1] - 0.5) / contrast : x[1] - 0.5; },
        [&](int f) { return -test::face_vector(mesh, f)[1]; }, 1e-10 * std::max(1.0, 1 / contrast), 0);
  }
}

/// The rows of either cell are sums of differences from its pressure with coefficients that are not negative.
TEST(Ntpfa, FluxesAreDifferencesFromThePressureOfEitherCell) {
  for (const Mesh& mesh : meshes()) {
    std::vector<Tensor> mobility(mesh.cell_count());
    for (Tensor& k : mobility) {
      const Tensor root = Tensor::Random();
      k = root * root.transpose() + 1e-2 * Tensor::Identity();
    }
    const FluxOperators operators = discretize_ntpfa(mesh, mobility, mixed_conditions(mesh));
    const auto expect_signs = [&](const SparseMatrix& rows, int face, int cell, double sign) {
      for (SparseMatrix::InnerIterator entry(rows, face); entry; ++entry)
        if (entry.col() != cell) {
          EXPECT_LE(sign * entry.value(), 1e-12) << face;
        }
    };
    for (int f = 0; f < mesh.face_count(); ++f) {
      const auto [first, second] = mesh.face_cells[f];
      expect_signs(operators.flux_cell, f, first, 1);
      if (second == none) continue;
      expect_signs(operators.flux_cell, f, second, -1);
      expect_signs(operators.limited[0].cell, f, first, 1);
      expect_signs(operators.limited[1].cell, f, second, -1);
    }
  }
}

TEST(LimitedFluxes, AreAHarmonicMeanWithItsDerivatives) {
  const Vector first = Vector::Random(200), second = Vector::Random(200);
  const LimitedFluxes at = limit(first, second);
  for (int i = 0; i < first.size(); ++i) {
    const double a = first[i], b = second[i];
    EXPECT_NEAR(at.value[i], a * b > 0 ? 2 * a * b / (a + b) : 0, 1e-15);
    EXPECT_LE(std::abs(at.value[i]), 2 * std::min(std::abs(a), std::abs(b)) + 1e-15);
    EXPECT_GE(at.value[i] * a, 0);
  }
  const double h = 1e-7;
  const Vector step = Vector::Constant(200, h);
  const Vector by_first = (limit(first + step, second).value - limit(first - step, second).value) / (2 * h);
  const Vector by_second = (limit(first, second + step).value - limit(first, second - step).value) / (2 * h);
  EXPECT_LT((by_first - at.by_first).lpNorm<Eigen::Infinity>(), 1e-5);
  EXPECT_LT((by_second - at.by_second).lpNorm<Eigen::Infinity>(), 1e-5);
  EXPECT_EQ(limit(Vector::Zero(1), Vector::Zero(1)).by_first[0], 0.5);
}

TEST(LimitedFluxes, AreAConvexMeanWithSecants) {
  const Vector first = Vector::Random(200), second = Vector::Random(200);
  const LimitedFluxes exact = limit(first, second), at = limit(first, second, with_secants);
  EXPECT_LT((at.value - exact.value).lpNorm<Eigen::Infinity>(), 1e-15);
  EXPECT_LT(
      (at.by_first.cwiseProduct(first) + at.by_second.cwiseProduct(second) - exact.value).lpNorm<Eigen::Infinity>(),
      1e-15);
  EXPECT_LT((at.by_first + at.by_second - Vector::Ones(200)).lpNorm<Eigen::Infinity>(), 1e-15);
  EXPECT_GE(std::min(at.by_first.minCoeff(), at.by_second.minCoeff()), 0);
  // They do not jump where a flux changes its sign.
  const Vector one = Vector::Ones(1), below = Vector::Constant(1, -1e-9), above = Vector::Constant(1, 1e-9);
  EXPECT_NEAR(limit(below, one, with_secants).by_first[0], limit(above, one, with_secants).by_first[0], 1e-8);
  EXPECT_NEAR(limit(above, one).by_first[0] - limit(below, one).by_first[0], 2, 1e-8);
}

TEST(LimitedFluxes, AreSmoothWhereRoundedAndTendToThemselves) {
  const Vector first = Vector::Random(200), second = Vector::Random(200);
  const Vector exact = limit(first, second).value;
  for (const double rounding : {1e-12, 1e-3, 1.0, 1e3}) {
    const LimitedFluxes at = limit(first, second, rounding);
    // x+ is off by at most rounding/2, and slopes of the mean are at most 2.
    EXPECT_LT((at.value - exact).lpNorm<Eigen::Infinity>(), 4 * rounding);
    const Vector step = Vector::Constant(200, 1e-6);
    const Vector by_first =
        (limit(first + step, second, rounding).value - limit(first - step, second, rounding).value) / 2e-6;
    const Vector by_second =
        (limit(first, second + step, rounding).value - limit(first, second - step, rounding).value) / 2e-6;
    if (rounding < 1e-3) continue;  // the difference quotient passes the kink
    EXPECT_LT((by_first - at.by_first).lpNorm<Eigen::Infinity>(), 1e-5) << rounding;
    EXPECT_LT((by_second - at.by_second).lpNorm<Eigen::Infinity>(), 1e-5) << rounding;
  }
  const Vector mean = (first + second) / 2;
  EXPECT_LT((limit(first, second, 1e3).value - mean).lpNorm<Eigen::Infinity>(), 1e-2);
  EXPECT_EQ(limit(first, second, std::numeric_limits<double>::infinity()).value, mean);
}

}  // namespace
}  // namespace sprekk::matrix_flow
