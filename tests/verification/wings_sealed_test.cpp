// Wings in sealed rock under a prescribed pressure: critical pressures as functions of the length of the wing.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "tests/verification/scene_run.hpp"

namespace sprekk::testing {
namespace {

struct Wing {
  double onset = 0;                      ///< Pa, at the end of the first step with growth
  std::vector<double> length, pressure;  ///< m, Pa; where it has grown
  double pressure_at(double wanted) const {
    std::size_t i = 1;
    while (i + 1 < length.size() && length[i] < wanted) ++i;
    return pressure[i - 1] + (wanted - length[i - 1]) / (length[i] - length[i - 1]) * (pressure[i] - pressure[i - 1]);
  }
};

/// To 9.2 MPa, where the wing is about 2.5 mm long. A tenth of an hour is 0.1 MPa.
Wing grow(const std::string& increment, const std::string& fracture_size) {
  SceneRun run("verification/wings_sealed.yaml", {{"components.tips.growth.increment", increment},
                                                  {"mesh.fracture_size", fracture_size},
                                                  {"time.step", "0.1 h"},
                                                  {"time.start", "7.9 h"}});
  Wing wing;
  run.run_until(9.2 * 3600, [&] {
    const double length = run.quantity("tips.main_last.length"), pressure = run.quantity("fracture_pressure");
    if (length == 0) return;
    if (wing.onset == 0) wing.onset = pressure;
    // From the first increment on the direction leaves no K_II, and so nothing that could alternate.
    EXPECT_LT(std::abs(run.quantity("tips.main_last.K_II")), 0.0101 * run.quantity("tips.main_last.K_I")) << pressure;
    // A tip waits until it can grow by 0.1 mm. At 0.5 mm that is worth 0.05 MPa, or 2 % of K_I; the tolerance is 1 %.
    if (length > 0.5e-3) {
      EXPECT_NEAR(run.quantity("tips.main_last.K_I"), 0.7e6, 0.03 * 0.7e6) << pressure;
    }
    wing.length.push_back(length);
    wing.pressure.push_back(pressure);
  });
  return wing;
}

TEST(WingsInSealedRock, CriticalPressuresDependOnNeitherIncrementNorMesh) {
  const Wing coarse = grow("10 mm", "10 mm"), fine = grow("5 mm", "5 mm");
  // D sqrt(pi b) = 0.601 MPa m^0.5 at 8.06 MPa; the factors are right to 1 %, which is worth 0.03 MPa, and a step is
  // 0.1 MPa.
  for (const Wing& wing : {coarse, fine}) {
    EXPECT_GT(wing.onset, 8.02e6);
    EXPECT_LT(wing.onset, 8.2e6 + 1e3);
  }
  for (const double length : {0.5e-3, 1e-3, 2e-3})
    EXPECT_NEAR(coarse.pressure_at(length) / fine.pressure_at(length), 1, 0.01) << length;
  EXPECT_TRUE(std::is_sorted(fine.length.begin(), fine.length.end()));
}

}  // namespace
}  // namespace sprekk::testing
