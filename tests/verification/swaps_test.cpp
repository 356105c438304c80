// Every component for every other of its role: the answers stay those of closed forms.
#include <fmt/format.h>
#include <gtest/gtest.h>

#include <cmath>

#include "tests/verification/mandel_solution.hpp"
#include "tests/verification/onset_crack.hpp"
#include "tests/verification/scene_run.hpp"
#include "tests/verification/swaps.hpp"

namespace sprekk::testing {
namespace {

std::string name_of_pair(const ::testing::TestParamInfo<Choice>& info) { return name_of(info.param); }

const auto flows = ::testing::Values("mpfa", "tpfa", "rt0", "ntpfa");
const auto rocks = ::testing::Values("mpsa", "fem_first", "fem_second");
const auto contacts = ::testing::Values("coulomb", "augmented_lagrangian");
const auto none = ::testing::Values("");

class SwapsInMandel : public ::testing::TestWithParam<Choice> {};
INSTANTIATE_TEST_SUITE_P(Pairs, SwapsInMandel, ::testing::Combine(flows, rocks, none), name_of_pair);

/// On squares that are cut by alternating diagonals, where two-point fluxes are consistent.
TEST_P(SwapsInMandel, AreOfSecondOrder) {
  const Mandel exact;
  double coarse = 0;
  for (const int cells : {10, 20}) {
    SceneRun run("verification/mandel.yaml",
                 with(GetParam(), {{"mesh", fmt::format("{{kind: structured, cells: [{0}, {0}]}}", cells)}}));
    run.run();
    Vector p(run.mesh().cell_count());
    for (int c = 0; c < p.size(); ++c) p[c] = exact.pressure(run.mesh().cell_center[c][0], run.time(), run.steps());
    const double error = relative_error(Eigen::Map<const Vector>(run.mesh().cell_measure.data(), p.size()),
                                        run.field("pore.pressure"), p);
    const double side = exact.displacement({1, 0.5}, run.time(), run.steps())[0];
    const double displacement = std::abs(run.quantity("u_side.x") / side - 1);
    RecordProperty(fmt::format("errors_{}", cells), fmt::format("p {:.3g}, u {:.3g}", error, displacement));
    if (cells == 20) {
      EXPECT_LT(error, 3e-3);
      EXPECT_LT(displacement, 1e-3);
      EXPECT_GT(std::log2(coarse / error), 1.75) << coarse << " " << error;
    }
    coarse = error;
  }
}

class SwapsInCracks : public ::testing::TestWithParam<Choice> {};
INSTANTIATE_TEST_SUITE_P(Pairs, SwapsInCracks, ::testing::Combine(none, rocks, contacts), name_of_pair);

/// The jump in the middle of a crack of half-length 1 m over the closed one, with 40 cells on it.
double middle_jump(SceneRun& run, int axis) {
  double nearest = 1e9, jump = 0, at = 0;
  for (int i = 0; i < run.mesh().fracture_cell_count(); ++i)
    if (const double x = run.mesh().fracture_cells[i].center.norm(); x < nearest) {
      nearest = at = x;
      jump = std::abs(run.field("contact.jump")[2 * i + axis]);
    }
  return jump / std::sqrt(1 - at * at);
}

TEST_P(SwapsInCracks, OpenLikeSneddonsAndSlipLikePhans) {
  const std::string mesh = "{size: 32 m, fracture_size: 0.05 m, growth: 0.1}";
  SceneRun open("verification/pressurized_crack.yaml", with(GetParam(), {{"mesh", mesh}}));
  ASSERT_TRUE(open.step());
  const double opening = 4 / (10e9 / (1 - 0.04)) * 1e6;
  SceneRun sheared("verification/frictional_crack.yaml", with(GetParam(), {{"mesh", mesh}}));
  ASSERT_TRUE(sheared.step());
  const double angle = 20 * M_PI / 180, normal = 100e6 * std::pow(std::sin(angle), 2);
  const double drop = 100e6 * std::sin(angle) * std::cos(angle) - normal * std::tan(30 * M_PI / 180);
  const double slip = 4 / (25e9 / (1 - 0.0625)) * drop;
  RecordProperty("errors",
                 fmt::format("{:.3g} {:.3g}", middle_jump(open, 0) / opening - 1, middle_jump(sheared, 1) / slip - 1));
  EXPECT_NEAR(middle_jump(open, 0) / opening, 1, 5e-3);
  EXPECT_NEAR(middle_jump(sheared, 1) / slip, 1, 5e-3);
}

class SwapsInSection51 : public ::testing::TestWithParam<Choice> {};
// Every two components of different roles are once together, at least: every contact with each flow and each rock, and
// every flow with each rock.
INSTANTIATE_TEST_SUITE_P(
    Pairs, SwapsInSection51,
    ::testing::Values(Choice{"mpfa", "mpsa", "coulomb"}, Choice{"mpfa", "fem_first", "augmented_lagrangian"},
                      Choice{"mpfa", "fem_second", "coulomb"}, Choice{"tpfa", "mpsa", "augmented_lagrangian"},
                      Choice{"tpfa", "fem_first", "coulomb"}, Choice{"tpfa", "fem_second", "augmented_lagrangian"},
                      Choice{"rt0", "mpsa", "coulomb"}, Choice{"rt0", "fem_first", "augmented_lagrangian"},
                      Choice{"rt0", "fem_second", "coulomb"}, Choice{"ntpfa", "mpsa", "augmented_lagrangian"},
                      Choice{"ntpfa", "fem_first", "coulomb"}, Choice{"ntpfa", "fem_second", "augmented_lagrangian"}),
    name_of_pair);

/// Section 5.1 of the paper with 20 cells on the fracture, at the end of the injection. Two-point fluxes are not
/// consistent on this mesh, which `check` says (0.11 % of the pressure far from the fracture; below where they are).
TEST_P(SwapsInSection51, SlipAndLoadTheTipsLikeTheCrackWithBackStress) {
  const std::vector<Override> scene = {{"mesh.fracture_size", "5 mm"}};
  SceneRun run("paper/onset.yaml", with(GetParam(), scene));
  run.run_until(21 * 3600);
  const OnsetCrack crack = onset_crack(run);
  static const double pressure = [&] {
    SceneRun reference("paper/onset.yaml", scene);
    reference.run_until(21 * 3600);
    return reference.quantity("p_C");
  }();
  RecordProperty(
      "errors",
      fmt::format("slip {:.3g}, K_II {:.3g} {:.3g}, p_C {:.3g}", std::abs(run.quantity("slip.t")) / crack.peak_slip - 1,
                  std::abs(run.quantity("tips.main_first.K_II")) / crack.k2 - 1,
                  std::abs(run.quantity("tips.main_last.K_II")) / crack.k2 - 1, run.quantity("p_C") / pressure - 1));
  const auto& [flow, rock, contact] = GetParam();
  EXPECT_NEAR(std::abs(run.quantity("slip.t")) / crack.peak_slip, 1, 0.01);
  EXPECT_NEAR(std::abs(run.quantity("tips.main_first.K_II")) / crack.k2, 1, 0.01);
  EXPECT_NEAR(std::abs(run.quantity("tips.main_last.K_II")) / crack.k2, 1, 0.01);
  EXPECT_NEAR(run.quantity("p_C") / pressure, 1, flow == "tpfa" ? 1.5e-3 : 1e-4);
}

/// The same on squares that are cut by alternating diagonals, along which the fracture lies: there two-point fluxes are
/// consistent, and only the pressure of the fluid that enters around tips differs (four cells on the fracture).
TEST(SwapsInSection51OnDiagonals, TwoPointFluxesGiveThePressureOfMultiPointOnes) {
  double reference = 0;
  for (const char* flow : {"mpfa", "tpfa"}) {
    SceneRun run(
        "paper/onset_coarse.yaml",
        with({flow, "mpsa", ""}, {{"geometry.fractures", "null"},
                                  {"geometry.fractures", "{main: {points: [[0.96 m, 0.96 m], [1.04 m, 1.04 m]]}}"},
                                  {"mesh", "null"},
                                  {"mesh", "{kind: structured, cells: [100, 100]}"}}));
    run.run_until(21 * 3600);
    const double pressure = run.quantity("p_C");
    if (reference == 0) reference = pressure;
    RecordProperty(flow, fmt::format("{:.3g}", pressure / reference - 1));
    EXPECT_NEAR(pressure / reference, 1, 3e-4) << flow;
  }
}

}  // namespace
}  // namespace sprekk::testing
