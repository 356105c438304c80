// Values by fracture: which fractures slip, and how much fluid they conduct, against closed forms.
#include <fmt/format.h>
#include <gtest/gtest.h>

#include <cmath>
#include <filesystem>
#include <fstream>

#include "tests/verification/scene_run.hpp"

namespace sprekk::testing {
namespace {

/// Three fractures of the same direction in a block under 20 and 10 MPa: on each, far from the others, the shear
/// traction is a third of the normal one (Mohr's circle: 5 MPa and 15 MPa at 45 degrees).
std::string block(const std::string& fractures, const std::string& friction, bool is_mirrored) {
  const std::string angle = is_mirrored ? "135 deg" : "45 deg";
  const auto line = [&](const std::string& name, double x) {
    return fmt::format("{}: {{center: [{} m, 10 m], length: 1 m, angle: {}}}", name, is_mirrored ? 20 - x : x, angle);
  };
  const std::string lines =
      fractures.empty() ? "{" + line("a", 4) + ", " + line("b", 10) + ", " + line("c", 16) + "}" : fractures;
  return R"(
geometry:
  box: {x: [0 m, 20 m], y: [0 m, 20 m]}
  fractures: )" +
         lines + R"(
mesh: {size: 2 m, fracture_size: 0.2 m}
materials: {young_modulus: 40 GPa, poisson_ratio: 0.2, dilation_angle: 0 deg}
components:
  rock:
    type: poromechanics/mpsa
    boundary:
      left: {displacement_x: 0 m}
      bottom: {displacement_y: 0 m}
      right: {normal_stress: -20 MPa}
      top: {normal_stress: -10 MPa}
  contact: {type: contact/coulomb, friction: )" +
         friction + R"(}
couplers:
  - {type: wall_traction, between: [rock, contact]}
schedule:
  - solve: [rock, contact]
time: {end: 1 h, step: 1 h}
)";
}

/// The largest slip of each fracture.
std::vector<double> slips(const std::string& scene) {
  SceneRun run = SceneRun::from_text(scene);
  EXPECT_TRUE(run.step());
  std::vector<double> largest(run.mesh().fractures.size(), 0);
  for (int i = 0; i < run.mesh().fracture_cell_count(); ++i) {
    double& slip = largest[run.mesh().fracture_cells[i].fracture];
    slip = std::max(slip, std::abs(run.field("contact.jump")[dimension * i + 1]));
  }
  return largest;
}

class Slips : public ::testing::TestWithParam<bool> {};
INSTANTIATE_TEST_SUITE_P(Mirrored, Slips, ::testing::Bool());

// A crack with the constant shear stress drop s slips by 4 (1 - nu^2) / E s a in its middle (Eshelby), a half of its
// length. Beside others 6 m away, and in a block of 20 m, this holds to a few per cent.
TEST_P(Slips, WhereTheirOwnFrictionIsTooSmall) {
  const std::vector<double> slip = slips(block("", "{fractures: {a: 0.2, b: 0.35, default: 0.3}}", GetParam()));
  ASSERT_EQ(slip.size(), 3u);
  const double by_drop = 4 * (1 - 0.04) / 40e9 * 0.5;
  EXPECT_NEAR(slip[0], by_drop * (5e6 - 0.2 * 15e6), 0.06 * by_drop * 2e6);
  EXPECT_LT(slip[1], 1e-12);
  EXPECT_NEAR(slip[2], by_drop * (5e6 - 0.3 * 15e6), 0.06 * by_drop * 0.5e6 + 0.02 * by_drop * 2e6);
}

TEST(SlipsOfATable, AreThoseOfTheSameValuesByName) {
  const auto folder = std::filesystem::temp_directory_path() / "sprekk_values_by_fracture";
  std::filesystem::create_directories(folder);
  const double h = 0.5 / std::sqrt(2.0);
  {
    std::ofstream table(folder / "network.csv");
    table << "name,x1,y1,x2,y2,friction\n";
    for (const auto& [name, x, friction] :
         std::vector<std::tuple<std::string, double, double>>{{"a", 4, 0.2}, {"b", 10, 0.35}, {"c", 16, 0.3}}) {
      table << fmt::format("{},{:.17g},{:.17g},{:.17g},{:.17g},{}\n", name, x - h, 10 - h, x + h, 10 + h, friction);
    }
  }
  const std::vector<double> of_table =
      slips(block("{table: " + (folder / "network.csv").string() + "}", "{column: friction}", false));
  const std::vector<double> by_name = slips(block("", "{fractures: {a: 0.2, b: 0.35, default: 0.3}}", false));
  ASSERT_EQ(of_table.size(), by_name.size());
  for (std::size_t i = 0; i < by_name.size(); ++i) EXPECT_NEAR(of_table[i], by_name[i], 1e-9 * by_name[0]);
  std::filesystem::remove_all(folder);
}

// Along two fractures from side to side, whose rock conducts nothing, the flux is the transmissivity times the
// gradient: the linear pressure is exact.
TEST(Conducts, EachFractureByItsOwnTransmissivity) {
  SceneRun run = SceneRun::from_text(R"(
geometry:
  box: {x: [0 m, 4 m], y: [0 m, 3 m]}
  fractures:
    low: {points: [[0 m, 1 m], [4 m, 1 m]]}
    high: {points: [[0 m, 2 m], [4 m, 2 m]]}
mesh: {size: 0.5 m}
materials: {viscosity: 1 mPa*s, fluid_compressibility: 0}
components:
  conduit:
    type: fracture_flow/tpfa
    initial_aperture: 1 mm
    transmissivity: constant
    transmissivity_value: {fractures: {low: 1e-12 m^3, high: (3e-12*(1 + t/day)) m^3}}
    boundary: {left: {pressure: {fractures: {low: 2 MPa, high: 4 MPa}}}, right: {pressure: 1 MPa}}
schedule:
  - solve: conduit
time: {end: 1 day, step: 1 day}
)");
  ASSERT_TRUE(run.step());
  const Vector& flux = run.field("conduit.flux");
  for (int i = 0; i < static_cast<int>(run.mesh().ridges.size()); ++i) {
    const Ridge& point = run.mesh().ridges[i];
    const bool is_high = run.mesh().fracture_cells[point.cells[0]].fracture == 1;
    const double exact = is_high ? 6e-12 / 1e-3 * 3e6 / 4 : 1e-12 / 1e-3 * 1e6 / 4;
    EXPECT_NEAR(std::abs(flux[i]), exact, 1e-9 * exact) << i;
  }
}

}  // namespace
}  // namespace sprekk::testing
