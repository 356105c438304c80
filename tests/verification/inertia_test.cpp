// Flow in fractures with inertia (Forchheimer): a wedge and a cross against their quadratic equations, and a fracture
// that leaks through its walls against the ordinary differential equation.
#include <fmt/format.h>
#include <gtest/gtest.h>

#include <cmath>
#include <string>

#include "tests/verification/mesh_file.hpp"
#include "tests/verification/scene_run.hpp"

namespace sprekk::testing {
namespace {

constexpr double beta = 2e7, density = 1000;  // 1/m, kg/m^3

std::string place(const Point& x) { return fmt::format("[{:.17g} m, {:.17g} m]", x.x(), x.y()); }

/// Fluid of 1 Pa s in fractures that start at the given cells; `more` belongs to the component, `rest` to the scene.
SceneRun steady(const std::string& fractures, double size, const std::string& more, const std::string& components = "",
                const std::string& couplers = "", const std::string& solve = "conduit") {
  return SceneRun::from_text(fmt::format(R"yaml(
geometry:
  box: {{x: [-2 m, 2 m], y: [-2 m, 2 m]}}
  fractures: {}
mesh: {{size: 0.8 m, fracture_size: {} m}}
components:
  conduit:
    type: fracture_flow/tpfa
    viscosity: 1 Pa*s
    fluid_compressibility: 0 1/Pa
    {}
  {}
couplers: [{}]
schedule: [{{solve: [{}]}}]
time: {{end: 1e9 s, step: 1e9 s}}
)yaml",
                                         fractures, size, more, components, couplers, solve));
}

/// The size of Q of I Q^2 + R Q = drop.
double quadratic(double resistance, double inertia, double drop) {
  return 2 * drop / (resistance + std::sqrt(resistance * resistance + 4 * inertia * drop));
}

/// Along a wedge of the aperture 0.01 + 0.02 s, s from 0 to 1 m along `direction`, in `pieces` fractures.
double flux_in_wedge(double degrees, double size, int pieces) {
  const Tensor turn = turned_by(degrees);
  const Point end = turn * Point(1, 0), middle = 0.5 * end;
  const std::string fractures = pieces == 1
                                    ? fmt::format("{{one: {{points: [[0 m, 0 m], {}]}}}}", place(end))
                                    : fmt::format("{{one: {{points: [[0 m, 0 m], {0}]}}, two: {{points: [{1}, {0}]}}}}",
                                                  place(middle), place(end));
  SceneRun run =
      steady(fractures, size,
             fmt::format("initial_aperture: \"(0.01 + 0.02*({:.17g}*x + {:.17g}*y))\"\n    law: {{type: cubic, "
                         "inertia: {} 1/m}}\n    prescribed: {{from: {{at: [0 m, 0 m], pressure: 1 Pa}}, to: "
                         "{{at: {}, pressure: 0 Pa}}}}",
                         turn(0, 0), turn(1, 0), beta, place(end)));
  run.run();
  return run.field("conduit.flux").lpNorm<Eigen::Infinity>();
}

TEST(Inertia, FlowThroughAWedgeIsOfSecondOrder) {
  const auto exact = [](double size) {
    const auto integral = [&](int power) {  // of a^(-power) between the first and the last centre
      const auto at = [&](double s) { return std::pow(0.01 + 0.02 * s, 1 - power) / (1 - power) / 0.02; };
      return at(1 - size / 2) - at(size / 2);
    };
    return quadratic(12 * integral(3), beta * density * integral(2), 1);
  };
  for (const int pieces : {1, 2})
    for (const double degrees : {0.0, 30.0}) {
      double before = 0;
      for (const double size : {0.1, 0.05, 0.025}) {
        const double error = std::abs(flux_in_wedge(degrees, size, pieces) / exact(size) - 1);
        EXPECT_LT(error, 12 * size * size) << pieces << " " << degrees << " " << size;
        if (before > 0) {
          EXPECT_GT(before / error, 3.5) << pieces << " " << degrees << " " << size;
        }
        before = error;
      }
    }
  // Inertia has an effect: without it nearly four times as much would flow.
  EXPECT_GT(1 / (12 * (std::pow(0.011, -2) - std::pow(0.029, -2)) / 0.04) / exact(0.1), 3);
}

/// From one arm of a cross of equal arms into the three others: the drops are R q + I q^2 and R q/3 + I (q/3)^2.
TEST(Inertia, ACrossSplitsAlike) {
  for (const double degrees : {0.0, 30.0, 77.0})
    for (const double coefficient : {0.0, beta, 1e4 * beta})
      for (const std::string law : {"type: cubic", "type: constant, transmissivity: 5e-6 m^3"}) {
        const Tensor turn = turned_by(degrees);
        const Point x = turn * Point(1, 0), y = turn * Point(0, 1);
        SceneRun run = steady(
            fmt::format("{{along: {{points: [{}, {}]}}, across: {{points: [{}, {}]}}}}", place(-x), place(x), place(-y),
                        place(y)),
            0.1,
            fmt::format("initial_aperture: 0.03 m\n    law: {{{}, inertia: {} 1/m}}\n    prescribed: {{from: {{at: {}, "
                        "pressure: 1 Pa}}, right: {{at: {}, pressure: 0 Pa}}, low: {{at: {}, pressure: 0 Pa}}, high: "
                        "{{at: {}, pressure: 0 Pa}}}}",
                        law, coefficient, place(-x), place(x), place(-y), place(y)));
        run.run();
        const double length = 1 - 0.05, k = law == "type: cubic" ? std::pow(0.03, 3) / 12 : 5e-6;
        const double resistance = length / k, inertia = coefficient * density * length / std::pow(12 * k, 2.0 / 3);
        const double flux = quadratic(resistance * 4 / 3, inertia * 10 / 9, 1);
        EXPECT_NEAR(run.field("conduit.flux").lpNorm<Eigen::Infinity>() / flux, 1, 1e-8) << degrees << " " << law;
      }
}

/// dQ/ds = −2 kappa p, dp/ds = −12 mu Q/a^3 − beta rho Q |Q|/a^2, Q(1) = 0 and p(start) = 1, by the classical method of
/// Runge and Kutta from s = 1 on: (p at `at`, Q at `start`).
std::pair<double, double> leaking(double kappa, double aperture, double start, double at) {
  const auto backwards = [&](double p, double to) {
    constexpr int steps = 4000;
    const double ds = (to - 1) / steps;
    double q = 0;
    const auto slope = [&](double p_now, double q_now) {
      return std::pair(
          -12 * q_now / std::pow(aperture, 3) - beta * density * q_now * std::abs(q_now) / (aperture * aperture),
          -2 * kappa * p_now);
    };
    for (int i = 0; i < steps; ++i) {
      const auto [p1, q1] = slope(p, q);
      const auto [p2, q2] = slope(p + ds / 2 * p1, q + ds / 2 * q1);
      const auto [p3, q3] = slope(p + ds / 2 * p2, q + ds / 2 * q2);
      const auto [p4, q4] = slope(p + ds * p3, q + ds * q3);
      p += ds / 6 * (p1 + 2 * p2 + 2 * p3 + p4);
      q += ds / 6 * (q1 + 2 * q2 + 2 * q3 + q4);
    }
    return std::pair(p, q);
  };
  double low = 0, high = 1;
  for (int i = 0; i < 60; ++i) (backwards((low + high) / 2, start).first < 1 ? low : high) = (low + high) / 2;
  return {backwards(low, at).first, backwards(low, start).second};
}

TEST(Inertia, AFractureThatLeaksFollowsTheDifferentialEquation) {
  constexpr double kappa = 1e-7, aperture = 0.03;
  for (const double degrees : {0.0, 30.0}) {
    const Point end = turned_by(degrees) * Point(1, 0);
    double before = 0;
    for (const double size : {0.1, 0.05, 0.025}) {
      SceneRun run =
          steady(fmt::format("{{one: {{points: [[0 m, 0 m], {}]}}}}", place(end)), size,
                 fmt::format("initial_aperture: {} m\n    law: {{type: cubic, inertia: {} 1/m}}\n    "
                             "normal_permeability: constant\n    normal_permeability_value: {} m/(Pa*s)\n    "
                             "prescribed: {{from: {{at: [0 m, 0 m], pressure: 1 Pa}}}}",
                             aperture, beta, kappa),
                 "pore: {type: matrix_flow/mpfa, permeability: 1 m^2, viscosity: 1 Pa*s, storage: 0 1/Pa, "
                 "boundary: {left: {pressure: 0 Pa}, right: {pressure: 0 Pa}}}",
                 "{type: wall_exchange, between: [pore, conduit]}", "pore, conduit");
      run.run();
      const auto [pressure, flux] = leaking(kappa, aperture, size / 2, 1 - size / 2);
      const double error = std::abs(run.field("conduit.pressure").minCoeff() / pressure - 1);
      EXPECT_LT(error, 0.5 * size) << degrees << " " << size;
      if (before > 0) {
        EXPECT_GT(before / error, 3.5) << degrees << " " << size;
      }
      before = error;
    }
  }
}

}  // namespace
}  // namespace sprekk::testing
