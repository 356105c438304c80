// A well beside rock of another permeability.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <string>
#include <utility>

#include "tests/verification/scene_run.hpp"

namespace sprekk::testing {
namespace {

/// Rock on the left and a tight lens in the middle, given by regions or by an expression.
std::string scene(const std::string& permeability) {
  return R"(
geometry:
  box: {x: [0 m, 10 m], y: [0 m, 4 m]}
  regions:
    lens: {polygon: [[4 m, 0 m], [6 m, 0 m], [6 m, 4 m], [4 m, 4 m]]}
mesh: {size: 0.5 m}
materials: {porosity: 0.1, fluid_compressibility: 4e-10 1/Pa, viscosity: 1 mPa*s}
components:
  pore:
    type: matrix_flow/mpfa
    permeability: )" +
         permeability + R"(
    initial_pressure: 1 MPa
    wells: {w: {at: [3.9 m, 2 m], rate: 1e-7 m^2/s}}
    boundary: {left: {pressure: 1 MPa}}
schedule: [{solve: pore}]
time: {end: 10 day, step: 1 day}
)";
}

/// Reference: the maximum principle. Fluid enters in the rock, so no pressure is higher than the highest there; the
/// lens takes up what diffuses into it, sqrt(c t) = 5 mm deep with c = k/(mu S).
TEST(Well, DoesNotFeedTheRockBesideIt) {
  for (const char* permeability :
       {"{regions: {rock: 1e-14 m^2, lens: 1e-24 m^2}}", "(if(x > 4 && x < 6, 1e-24, 1e-14)) m^2"}) {
    SceneRun run = SceneRun::from_text(scene(permeability));
    run.run();
    double rock = 0, lens = 0;
    for (int c = 0; c < run.mesh().cell_count(); ++c) {
      const double x = run.mesh().cell_center[c][0];
      double& largest = x > 4 && x < 6 ? lens : rock;
      largest = std::max(largest, run.field("pore.pressure")[c]);
    }
    EXPECT_GT(rock, 1.01e6);
    EXPECT_LT(lens, rock);
    EXPECT_LT(lens - 1e6, 0.02 * (rock - 1e6));
  }
}

/// A well near a change of permeability, in rock that is so tight that fluid stays where it is added in one short step.
/// Reference: the amounts have the position of the well as their mean, whichever cells get them; up to half or twice
/// the permeability the rock is of the same kind.
TEST(Well, FeedsRockOfAlmostThePermeabilityOfItsCell) {
  for (const auto& [ratio, is_fed] : {std::pair{"1.9", true}, {"1/1.9", true}, {"2.1", false}, {"1/2.1", false}}) {
    std::string text = scene(std::string("(1e-30*if(x > 4 && x < 6, ") + ratio + ", 1)) m^2");
    text.replace(text.find("10 day, step: 1 day"), 19, "1 s, step: 1 s");
    text.erase(text.find("  regions:"), text.find("mesh:") - text.find("  regions:"));
    SceneRun run = SceneRun::from_text(text);
    run.run();
    double all = 0, lens = 0;
    Point mean(0, 0);
    for (int c = 0; c < run.mesh().cell_count(); ++c) {
      const double amount = (run.field("pore.pressure")[c] - 1e6) * run.mesh().cell_measure[c];
      all += amount;
      mean += amount * run.mesh().cell_center[c];
      if (run.mesh().cell_center[c][0] > 4) lens += amount;
    }
    mean /= all;
    EXPECT_NEAR((mean - Point(3.9, 2)).norm(), 0, 1e-6) << ratio;
    if (is_fed)
      EXPECT_GT(std::abs(lens), 0.01 * all) << ratio;
    else
      EXPECT_NEAR(lens, 0, 1e-9 * all) << ratio;
  }
}

}  // namespace
}  // namespace sprekk::testing
