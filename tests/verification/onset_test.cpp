// Section 5.1 of the paper against closed forms: loading, uniform injection, and a slipping crack with poroelastic back
// stress.
#include <gtest/gtest.h>

#include <cmath>
#include <map>

#include "tests/verification/onset_crack.hpp"

namespace sprekk::testing {
namespace {

constexpr double hour = 3600;

TEST(Onset, LoadingAndInjectionMatchClosedForms) {
  SceneRun run("paper/onset_coarse.yaml");
  const auto corner = [&] { return std::hypot(run.quantity("u_D.x"), run.quantity("u_D.y")); };
  run.run_until(6 * hour);
  EXPECT_NEAR(run.quantity("p_C") / 6.902e6, 1, 0.01);
  EXPECT_NEAR(corner() / 0.6425e-3, 1, 0.01);
  run.run_until(30 * hour);
  EXPECT_NEAR(run.quantity("p_C") / 7.981e6, 1, 0.015);
  EXPECT_NEAR(corner() / 0.6102e-3, 1, 0.015);
}

TEST(Onset, TractionsAndSlipMatchTheCrackWithBackStress) {
  // 5, 20 and 50 cells on the fracture. Tractions within 0.1 MPa, on 5 cells but for those at the tips (0.14 MPa).
  struct Case {
    const char* size;
    bool with_tips;
    double slip;  ///< relative error at the centre
  };
  for (const auto& [size, with_tips, slip] :
       {Case{"20 mm", false, 0.025}, {"5 mm", true, 0.01}, {"2 mm", true, 0.01}}) {
    SceneRun run("paper/onset_coarse.yaml", {{"mesh.fracture_size", size}});
    run.run_until(21 * hour, [&] {
      const OnsetCrack crack = onset_crack(run);
      const int last = run.mesh().fracture_cell_count() - 1;
      for (int i = with_tips ? 0 : 1; i <= (with_tips ? last : last - 1); ++i) {
        EXPECT_NEAR(run.field("contact.traction")[2 * i], crack.normal, 0.1e6) << run.time() << " cell " << i;
        EXPECT_NEAR(std::abs(run.field("contact.traction")[2 * i + 1]), crack.shear, 0.1e6) << run.time();
      }
      EXPECT_NEAR(std::abs(run.quantity("slip.t")) / crack.peak_slip, 1, slip) << size << ", " << run.time() / hour;
    });
  }
}

TEST(Onset, SlipStaysWhenInjectionEnds) {
  SceneRun run("paper/onset_coarse.yaml", {{"mesh.fracture_size", "10 mm"}, {"mesh.size", "0.2 m"}});
  run.run_until(21 * hour);
  const Vector before = run.field("contact.jump");
  run.run_until(30 * hour);
  for (int i = 0; i < before.size(); ++i)
    EXPECT_NEAR(run.field("contact.jump")[i], before[i], 1e-9 * before.lpNorm<Eigen::Infinity>());
}

}  // namespace
}  // namespace sprekk::testing
