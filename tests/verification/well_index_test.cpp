// The index of a well in a cell, in a steady flow and before: Peaceman and Theis.
#include <fmt/format.h>
#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <numbers>

#include "components/capabilities/fluid_fluxes.hpp"
#include "couplers/well_exchange/plane/early_resistance.hpp"
#include "couplers/well_exchange/plane/equivalent_radius.hpp"
#include "framework/mesh/search/point_location.hpp"
#include "tests/verification/balance_error.hpp"

namespace sprekk::testing {
namespace {

const MatrixFluxes& fluxes_of(SceneRun& run) {
  for (const Part* part : run.model().parts())
    if (const auto* fluxes = dynamic_cast<const MatrixFluxes*>(part)) return *fluxes;
  throw std::logic_error("no flow");
}

PointSource at_point(const Mesh& mesh, const Point& at) {
  return point_source(mesh, at, [](int) { return true; });
}

/// Reference: Peaceman 1983, e^-gamma/4 sqrt(sqrt(k_y/k_x) h_x^2 + sqrt(k_x/k_y) h_y^2), for the two-point flux on
/// rectangles without end, with a source in one cell. The patch of eight layers gives it to 1.5e-3.
TEST(WellIndex, EquivalentRadiusIsPeacemans) {
  for (const auto& [hx, hy, kx, ky] :
       {std::array{20.0, 20.0, 1.0, 1.0}, {20.0, 10.0, 1.0, 1.0}, {20.0, 20.0, 4.0, 1.0}, {15.0, 20.0, 1.0, 3.0}}) {
    SceneRun run("verification/theis.yaml",
                 {{"geometry.box", fmt::format("{{x: [0 m, {} m], y: [0 m, {} m]}}", 51 * hx, 51 * hy)},
                  {"components.pore.type", "matrix_flow/tpfa"},
                  {"materials.permeability", fmt::format("{{xx: {}e-13 m^2, yy: {}e-13 m^2}}", kx, ky)},
                  {"components.wells.wells.feed.at", fmt::format("[{} m, {} m]", 25.5 * hx, 25.5 * hy)}});
    const Point at(25.5 * hx, 25.5 * hy);
    const Tensor mobility = Point(kx, ky).asDiagonal();
    const double found = *couplers::equivalent_radius(run.mesh(), fluxes_of(run), at_point(run.mesh(), at), mobility);
    const double exact =
        std::exp(-std::numbers::egamma) / 4 * std::sqrt(std::sqrt(ky / kx) * hx * hx + std::sqrt(kx / ky) * hy * hy);
    std::printf("r_e %.5f m, Peaceman %.5f m: %.1e\n", found, exact, found / exact - 1);
    EXPECT_NEAR(found / exact, 1, 2e-3);
  }
}

/// A mesh and a rock with a well; `at`: a point of the cell of the well.
struct TheisCase {
  std::string name, type, mesh, permeability;
  Point at;
  Tensor mobility;
};

Tensor tensor(double xx, double yy, double xy) { return (Tensor() << xx, xy, xy, yy).finished(); }

std::string theis(const TheisCase& of, double step, double end) {
  return fmt::format(R"(
geometry: {{box: {{x: [0 m, 1020 m], y: [0 m, 1020 m]}}}}
mesh: {}
components:
  pore: {{type: {}, permeability: {}, viscosity: 1 mPa*s, storage: 1e-9 1/Pa, initial_pressure: 20 MPa}}
  wells: {{type: wells/limited, wells: {{feed: {{at: [{} m, {} m], rate: 1e-4 m^2/s, radius: 0.1 m}}}}}}
couplers: [{{type: well_exchange, between: [wells, pore]}}]
schedule: [{{solve: [pore, wells]}}]
time: {{end: {} s, step: {} s}}
)",
                     of.mesh, of.type, of.permeability, of.at[0], of.at[1], end, step);
}

/// The meshes and rocks in which a well is compared with Theis.
std::vector<TheisCase> theis_cases() {
  const std::string squares = "{kind: structured, cells: [51, 51], shape: quadrilaterals}";
  const std::string triangles = "{kind: structured, cells: [51, 51], shape: triangles}";
  const std::string isotropic = "1e-13 m^2", along = "{xx: 4e-13 m^2, yy: 1e-13 m^2}";
  const std::string oblique = "{along: 4e-13 m^2, across: 1e-13 m^2, angle: 30 deg}";
  const Tensor one = tensor(1e-10, 1e-10, 0), four = tensor(4e-10, 1e-10, 0);
  const double c = std::cos(std::numbers::pi / 6), s = 0.5;
  const Tensor turned = tensor(4e-10 * c * c + 1e-10 * s * s, 4e-10 * s * s + 1e-10 * c * c, 3e-10 * c * s);
  return {{"squares, two points", "matrix_flow/tpfa", squares, isotropic, {510, 510}, one},
          {"squares, multi-point", "matrix_flow/mpfa", squares, isotropic, {510, 510}, one},
          {"squares, beside the middle", "matrix_flow/mpfa", squares, isotropic, {513, 508}, one},
          {"triangles", "matrix_flow/mpfa", triangles, isotropic, {513, 507}, one},
          {"unstructured", "matrix_flow/mpfa", "{size: 22 m}", isotropic, {508, 511}, one},
          {"anisotropic, two points", "matrix_flow/tpfa", squares, along, {510, 510}, four},
          {"anisotropic, oblique", "matrix_flow/mpfa", squares, oblique, {510, 510}, turned},
          {"anisotropic, triangles", "matrix_flow/mpfa", "{size: 22 m}", oblique, {508, 511}, turned}};
}

/// The rise of the pressure (Pa) at the time t after a well of 1e-4 m^2/s has begun.
double theis_pressure(const Tensor& mobility, double t) {
  const double size = std::sqrt(mobility.determinant()), bore = couplers::radius_of_bore_hole(0.1, mobility);
  return 1e-4 / (4 * std::numbers::pi * size) * -std::expint(-bore * bore / (4 * size / 1e-9 * t));
}

/// Reference: Theis 1935, also in anisotropic rock, where the bore hole is a circle of radius_of_bore_hole. From 25
/// r_e^2/c on, Peaceman's bound for squares, where on triangles the flow has hardly left the cell of the well: with the
/// steady index alone the error was up to 6 % there. Then the well is shut, and its pressure falls: by superposition
/// as that of two wells (Horner).
TEST(WellIndex, PressureIsThatOfTheis) {
  for (const TheisCase& each : theis_cases()) {
    SceneRun trial = SceneRun::from_text(theis(each, 1, 1));
    const int home = PointLocation(trial.mesh()).cell_at(each.at);
    const double radius =
        *couplers::equivalent_radius(trial.mesh(), fluxes_of(trial), at_point(trial.mesh(), each.at), each.mobility);
    const double diffusivity = std::sqrt(each.mobility.determinant()) / 1e-9;
    const double first = 25 * radius * radius / diffusivity, filled = 4 * trial.mesh().cell_measure[home] / diffusivity;
    const double shut = 2 * filled, last = 3 * filled;
    ASSERT_LT(std::sqrt(4 * each.mobility.diagonal().maxCoeff() / 1e-9 * last), 510 / 2.0);  // the sides feel nothing
    std::string scene = theis(each, filled / 100, last);
    const std::string rate = "rate: 1e-4 m^2/s";
    scene.replace(scene.find(rate), rate.size(), fmt::format("rate: {{value: 1e-4 m^2/s, to: {} s}}", shut));
    SceneRun run = SceneRun::from_text(scene);
    double worst = 0, late = 0, after = 0;
    run.run_until(last, [&] {
      const double rise = run.quantity("wells.feed.pressure") - 20e6, t = run.time();
      const double whole = theis_pressure(each.mobility, t);
      if (t > shut * (1 + 1e-9)) {
        if (t >= shut + first)
          after = std::max(after, std::abs(rise - whole + theis_pressure(each.mobility, t - shut)) / whole);
        return;
      }
      const double error = std::abs(rise / whole - 1);
      if (t >= first) worst = std::max(worst, error);
      if (t >= filled) late = std::max(late, error);
    });
    std::printf("%s: r_e %.2f m, c t/A from %.2f on: worst %.2e, from 4 on %.2e, when shut %.2e\n", each.name.c_str(),
                radius, first * diffusivity / trial.mesh().cell_measure[home], worst, late, after);
    EXPECT_LT(worst, 0.01) << each.name;
    EXPECT_LT(late, 0.005) << each.name;
    EXPECT_LT(after, 0.01) << each.name;
    EXPECT_LT(balance_error(run), 1e-9) << each.name;
  }
}

/// The resistance is positive over each time, and from some c t on it is the steady one: otherwise a well that holds a
/// pressure would be unstable.
TEST(WellIndex, EarlyResistanceIsPositive) {
  for (const TheisCase& each : theis_cases()) {
    SceneRun trial = SceneRun::from_text(theis(each, 1, 1));
    const int home = PointLocation(trial.mesh()).cell_at(each.at);
    const double area = trial.mesh().cell_measure[home];
    for (const double bore : {1e-3, 1.0}) {
      const couplers::EarlyResistance early = *couplers::early_resistance(
          trial.mesh(), fluxes_of(trial), at_point(trial.mesh(), each.at), each.mobility, bore);
      double least = early.log_of_radii;
      for (double length = 1e-8 * bore * bore; length < 1e8 * area; length *= 1.5) {
        double resistance = early.log_of_radii;
        for (int k = 0; k < couplers::early_terms; ++k) resistance += early.weights[k] / (1 + length / early.scales[k]);
        least = std::min(least, resistance);
        if (length > 1e4 * area) {
          EXPECT_NEAR(resistance / early.log_of_radii, 1, 1e-3) << each.name;
        }
      }
      EXPECT_GT(least, 0) << each.name << ", bore hole of " << bore;
    }
  }
}

}  // namespace
}  // namespace sprekk::testing
