// Laws for the hydraulic aperture in runs: steady flow through a wedge against integrals, a residual aperture that
// conducts and has no volume, and the old way to write a constant transmissivity.
#include <fmt/format.h>
#include <gtest/gtest.h>

#include <cmath>

#include "tests/verification/scene_run.hpp"

namespace sprekk::testing {
namespace {

/// Fluid at 1 Pa s flows along a fracture of 1 m between pressures of 1 and 0 Pa; turned by 30 degrees where it says
/// so. The initial aperture is an expression of s, m along the fracture.
std::string scene(const std::string& law, const std::string& aperture, double size, bool turned,
                  const std::string& times) {
  const double x = turned ? std::cos(M_PI / 6) : 1, y = turned ? 0.5 : 0;
  std::string along = aperture;
  for (std::size_t at; (at = along.find('s')) != std::string::npos;)
    along.replace(at, 1, fmt::format("({:.17g}*x + {:.17g}*y)", x, y));
  return fmt::format(R"yaml(
geometry:
  box: {{x: [-1 m, 2 m], y: [-1 m, 2 m]}}
  fractures: {{main: {{points: [[0 m, 0 m], [{0:.17g} m, {1:.17g} m]]}}}}
mesh: {{size: 0.6 m, fracture_size: {2} m}}
components:
  conduit:
    type: fracture_flow/tpfa
    viscosity: 1 Pa*s
    fluid_compressibility: 1e-3 1/Pa
    initial_aperture: "({3})"
    {4}
    prescribed:
      from: {{at: [0 m, 0 m], pressure: 1 Pa}}
      to: {{at: [{0:.17g} m, {1:.17g} m], pressure: 0 Pa}}
schedule: [{{solve: [conduit]}}]
time: {5}
)yaml",
                     x, y, size, along, law, times);
}

/// The flux, m^2/s, and the distance between the first and the last centre of cells.
double steady_flux(const std::string& law, const std::string& aperture, double size, bool turned) {
  SceneRun run = SceneRun::from_text(scene(law, aperture, size, turned, "{end: 1e9 s, step: 1e9 s}"));
  run.run_until(1e9);
  const Vector flux = run.field("conduit.flux").cwiseAbs();
  return flux.maxCoeff();
}

/// 1/Int 12 mu (1 + 6 (e/a)^1.5)/a^3 ds between the centres, a = 0.01 + 0.02 s.
double flux_through_wedge(double roughness, double size) {
  const auto integral = [&](double s) {
    const double a = 0.01 + 0.02 * s;
    return -12 * (std::pow(a, -2) / 2 + 6 * std::pow(roughness, 1.5) * std::pow(a, -3.5) / 3.5) / 0.02;
  };
  return 1 / (integral(1 - size / 2) - integral(size / 2));
}

TEST(HydraulicLaw, FlowThroughAWedgeIsOfSecondOrder) {
  for (const double roughness : {0.0, 0.01})
    for (const bool turned : {false, true}) {
      const std::string law = roughness > 0 ? "law: {type: rough, roughness: 0.01 m}" : "law: {type: cubic}";
      double before = 0;
      for (const double size : {0.1, 0.05, 0.025}) {
        const double error =
            std::abs(steady_flux(law, "0.01 + 0.02*s", size, turned) / flux_through_wedge(roughness, size) - 1);
        EXPECT_LT(error, 12 * size * size) << roughness << " " << size;
        if (before > 0) {
          EXPECT_GT(before / error, 3.5) << roughness << " " << size;
        }
        before = error;
      }
    }
}

TEST(HydraulicLaw, AResidualApertureConductsAndHasNoVolume) {
  // h^3/12 dp/ds, whatever the aperture is, as long as it is narrower.
  for (const char* aperture : {"1e-9", "1e-4"}) {
    const double flux = steady_flux("law: {type: cubic, residual: 1 mm}", aperture, 0.1, true);
    EXPECT_NEAR(flux / (1e-9 / 12 / 0.9), 1, 1e-6) << aperture;
  }
  // What is stored goes with the aperture itself: pressures rise ten times as fast in a tenth of it.
  const auto stored = [](const char* aperture) {
    SceneRun run = SceneRun::from_text(
        scene("law: {type: cubic, residual: 1 mm}", aperture, 0.1, false, "{end: 1e9 s, step: 1e9 s}"));
    run.run_until(1e9);
    const Vector balance = run.field("conduit.cumulative_balance");
    double sum = 0;
    for (Eigen::Index i = 0; i < balance.size(); i += 3) sum += balance[i];
    return sum;
  };
  EXPECT_NEAR(stored("1e-5") / (1e-5 * 1e-3 * 0.5), 1, 1e-6);  // L a c_p times the mean pressure
  EXPECT_NEAR(stored("1e-4") / stored("1e-5"), 10, 1e-6);
}

TEST(HydraulicLaw, AConstantTransmissivityIsTheSameInBothSpellings) {
  const double by_law = steady_flux("law: {type: constant, transmissivity: 2 m^3}", "0.1", 0.1, false);
  const double as_before = steady_flux("transmissivity: constant\n    transmissivity_value: 2 m^3", "0.1", 0.1, false);
  EXPECT_EQ(by_law, as_before);
  EXPECT_NEAR(by_law / (2 / 0.9), 1, 1e-12);
}

TEST(HydraulicLaw, ContradictionsAreRefused) {
  const auto refused = [](const std::string& law) {
    try {
      SceneRun::from_text(scene(law, "0.1", 0.5, false, "{end: 1 s, step: 1 s}"));
    } catch (const std::exception& error) {
      return std::string(error.what());
    }
    return std::string();
  };
  for (const auto& [law, problem] : std::vector<std::pair<std::string, std::string>>{
           {"law: {type: rough}", "'roughness' is missing"},
           {"law: {type: cubic, roughness: 1 mm}", "'roughness' has no effect"},
           {"law: {type: constant}", "'transmissivity' is missing"},
           {"law: {type: constant, transmissivity: 1 m^3, residual: 1 mm}", "'residual' has no effect"},
           {"law: {type: cubic, transmissivity: 1 m^3}", "'transmissivity' has no effect"},
           {"law: {type: cubic}\n    transmissivity: cubic_law", "contradicts 'law'"},
           {"law: {type: cubic, residual: -1 mm}", "residual"}})
    EXPECT_NE(refused(law).find(problem), std::string::npos) << law << ": " << refused(law);
}

}  // namespace
}  // namespace sprekk::testing
