// Fractures whose properties vary within a cell, also without a bound.
#include <fmt/format.h>
#include <gtest/gtest.h>

#include <cmath>

#include "tests/verification/scene_run.hpp"

namespace sprekk::testing {
namespace {

const Point tip(0.3, 0.4), end(1, 0.68);

/// Of the pressure in a fracture from a tip to a side, where it is 1, in rock without pressure: p'' = 2 kappa p with
/// kappa = c s^(-1/2), p'(0) = 0, s the distance from the tip. p is a series of powers of s^(3/2).
double largest_error(double size) {
  constexpr double c = 1.5;
  SceneRun run = SceneRun::from_text(fmt::format(
      R"scene(
geometry: {{box: {{x: [0, 1], y: [0, 1]}}, fractures: {{f: {{points: [[{0}, {1}], [{2}, {3}]]}}}}}}
mesh: {{size: 0.3, fracture_size: {4}, growth: 0.5}}
components:
  pore: {{type: matrix_flow/mpfa, viscosity: 1 Pa*s, permeability: 1e8 m^2, storage: 0 1/Pa,
    boundary: {{left: {{pressure: 0 Pa}}, right: {{pressure: 0 Pa}}, bottom: {{pressure: 0 Pa}}, top: {{pressure: 0 Pa}}}}}}
  conduit: {{type: fracture_flow/tpfa, viscosity: 1 Pa*s, fluid_compressibility: 0 1/Pa, initial_aperture: 1 m,
    transmissivity: constant, transmissivity_value: 1 m^3, normal_permeability: constant,
    normal_permeability_value: "({5}*((x-{0})^2+(y-{1})^2)^(-0.25)) m/(Pa*s)", boundary: {{right: {{pressure: 1 Pa}}}}}}
couplers: [{{type: wall_exchange, between: [pore, conduit]}}]
schedule: [{{solve: [pore, conduit]}}]
time: {{end: 1 s, step: 1 s}}
)scene",
      tip.x(), tip.y(), end.x(), end.y(), size, c));
  run.run();
  const auto series = [&](double s) {
    double sum = 0, term = 1;
    for (int n = 1; n < 60; ++n) {
      sum += term;
      term *= 2 * c * std::pow(s, 1.5) / (1.5 * n * (1.5 * n - 1));
    }
    return sum;
  };
  const Vector& pressure = run.field("conduit.pressure");
  double error = 0;
  for (int i = 0; i < pressure.size(); ++i) {
    const double s = (run.mesh().fracture_cells[i].center - tip).norm();
    error = std::max(error, std::abs(pressure[i] - series(s) / series((end - tip).norm())));
  }
  return error;
}

TEST(FractureMeans, ANormalPermeabilityWithoutBoundAtATipCountsInFull) {
  const double coarse = largest_error(0.1), fine = largest_error(0.05), finest = largest_error(0.025);
  EXPECT_LT(coarse, 0.004);
  EXPECT_GT(std::log2(coarse / fine), 1.6);
  EXPECT_GT(std::log2(fine / finest), 1.6);
}

/// Flow between two sides through a transmissivity of sqrt(x): half cells are in series, so the flux is exact.
TEST(FractureMeans, AResistanceWithoutBoundAtAnEndCountsInFull) {
  for (const double rise : {0.0, 0.37})
    for (const int cells : {2, 9}) {
      const double length = std::hypot(1, rise);
      SceneRun run = SceneRun::from_text(fmt::format(
          R"scene(
geometry: {{box: {{x: [0, 1], y: [0, 1]}}, fractures: {{f: {{points: [[0, 0.3], [1, {}]]}}}}}}
mesh: {{size: 0.6, fracture_size: {}}}
components:
  conduit: {{type: fracture_flow/tpfa, viscosity: 2 Pa*s, fluid_compressibility: 0 1/Pa, initial_aperture: 1 m,
    transmissivity: constant, transmissivity_value: (sqrt(x)) m^3, boundary: {{left: {{pressure: 1 Pa}}, right: {{pressure: 4 Pa}}}}}}
schedule: [{{solve: conduit}}]
time: {{end: 1 s, step: 1 s}}
)scene",
          0.3 + rise, length / cells));
      run.run();
      // Integral of ds / K = 2 length.
      const Vector& flux = run.field("conduit.flux");
      EXPECT_NEAR(flux.cwiseAbs().maxCoeff(), 3 / (2 * 2 * length), 1e-6);
      const Vector& pressure = run.field("conduit.pressure");
      for (int i = 0; i < pressure.size(); ++i)
        EXPECT_NEAR(pressure[i], 1 + 3 * std::sqrt(run.mesh().fracture_cells[i].center.x()), 3e-6);
    }
}

}  // namespace
}  // namespace sprekk::testing
