// Heat that loads the rock.
#include <fmt/format.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>

#include "tests/verification/scene_run.hpp"

namespace sprekk::testing {
namespace {

constexpr double poisson = 0.2, expansion = 1e-5, diffusivity = 3 / 2.5e6, dt = 1e4, heating = 100;

std::string column(int layers, const std::string& rock, const std::string& schedule) {
  return fmt::format(R"(
geometry: {{box: {{x: [0 m, 0.1 m], y: [0 m, 1 m]}}}}
mesh: {{kind: structured, cells: [{}, {}]}}
components:
  heat: {{type: matrix_heat/mpfa, conductivity: 3 W/(m*K), heat_capacity: 2.5e6 J/(m^3*K), initial_temperature: 300 K, boundary: {{bottom: {{temperature: 400 K}}}}}}
  rock: {{type: {}, young_modulus: 40 GPa, poisson_ratio: 0.2, boundary: {{left: {{displacement_x: 0 m}}, right: {{displacement_x: 0 m}}, bottom: {{displacement_y: 0 m}}}}}}
couplers: [{{type: thermal_stress, between: [heat, rock], expansion: 1e-5 1/K}}]
schedule: {}
time: {{end: 1e5 s, step: 1e4 s}}
)",
                     layers / 10, layers, rock, schedule);
}

/// The temperature and its integral from the lower end to y, over those of the heating, after some steps. Reference:
/// the series for backward Euler, 1 − sum of 2/n sin(n y) (1 + c dt n^2)^−m with n = (k + 1/2) pi.
struct Warmth {
  double temperature, integral;
};
Warmth warmth(double y, int steps) {
  Warmth at{1, y};
  for (int k = 0; k < 400; ++k) {
    const double n = (k + 0.5) * std::numbers::pi, decay = std::pow(1 + diffusivity * dt * n * n, -steps);
    at.temperature -= 2 / n * std::sin(n * y) * decay;
    at.integral -= 2 / (n * n) * (1 - std::cos(n * y)) * decay;
  }
  return at;
}

/// The largest error of any step and place, of the temperature over the heating and of the displacement over that of
/// the top: alpha_T (1 + nu)/(1 − nu) times the integral of the temperature in a column that cannot widen.
double column_error(int layers, const std::string& rock, const std::string& schedule) {
  SceneRun run = SceneRun::from_text(column(layers, rock, schedule));
  const double stretch = expansion * (1 + poisson) / (1 - poisson) * heating;
  double worst = 0;
  for (int step = 1; step <= 10; ++step) {
    EXPECT_TRUE(run.step());
    const Vector &temperature = run.field("heat.temperature"), &displacement = run.field("rock.displacement");
    const Mesh& mesh = run.mesh();
    for (int c = 0; c < mesh.cell_count(); ++c)
      worst = std::max(worst,
                       std::abs((temperature[c] - 300) / heating - warmth(mesh.cell_center[c][1], step).temperature));
    const double top = stretch * warmth(1, step).integral;
    const bool on_cells = displacement.size() == 2 * mesh.cell_count();
    for (int i = 0; i < displacement.size() / 2; ++i) {
      const double y = on_cells ? mesh.cell_center[i][1] : mesh.nodes[i][1];
      worst = std::max(worst, std::abs(displacement[2 * i + 1] - stretch * warmth(y, step).integral) / top);
    }
  }
  return worst;
}

TEST(ThermalStress, ColumnIsThatOfTheClosedForm) {
  const std::string together = "[{solve: [heat, rock]}]", in_turn = "[{solve: heat}, {solve: rock}]";
  for (const std::string rock : {"poromechanics/mpsa", "poromechanics/fem"}) {
    const double coarse = column_error(40, rock, together), fine = column_error(80, rock, together);
    std::printf("%s: errors %.2e, %.2e, order %.2f\n", rock.c_str(), coarse, fine, std::log2(coarse / fine));
    EXPECT_GT(std::log2(coarse / fine), 1.8);
    EXPECT_LT(fine, 1.5e-3);
    EXPECT_NEAR(column_error(40, rock, in_turn) / coarse, 1, 1e-6);
  }
}

/// Reference: rock that is free to move expands by alpha_T (1 + nu) of the heating in plane strain, without stress in
/// the plane; a source of heat warms all of it alike.
TEST(ThermalStress, FreeRockExpandsEvenly) {
  SceneRun run = SceneRun::from_text(R"(
geometry: {box: {x: [0 m, 2 m], y: [0 m, 1 m]}}
mesh: {size: 0.3 m}
components:
  heat: {type: matrix_heat/mpfa, conductivity: 3 W/(m*K), heat_capacity: 2.5e6 J/(m^3*K), initial_temperature: 300 K, source: 1e3 W/m^3}
  rock: {type: poromechanics/mpsa, young_modulus: 40 GPa, poisson_ratio: 0.2, boundary: {left: {displacement_x: 0 m}, bottom: {displacement_y: 0 m}}}
couplers: [{type: thermal_stress, between: [heat, rock], expansion: 1e-5 1/K}]
schedule: [{solve: [heat, rock]}]
time: {end: 1e5 s, step: 5e4 s}
)");
  run.run();
  const double warmer = 1e3 * 1e5 / 2.5e6, strain = expansion * (1 + poisson) * warmer;
  for (int c = 0; c < run.mesh().cell_count(); ++c) {
    EXPECT_NEAR(run.field("heat.temperature")[c], 300 + warmer, 1e-9);
    for (int k = 0; k < 2; ++k)
      EXPECT_NEAR(run.field("rock.displacement")[2 * c + k], strain * run.mesh().cell_center[c][k], 1e-9 * strain);
  }
}

}  // namespace
}  // namespace sprekk::testing
