// The fine level on a run of section 5.1: refined to a tolerance, and with an error that is known.
#include <gtest/gtest.h>

#include <cmath>

#include "tests/verification/scene_run.hpp"

namespace sprekk::testing {
namespace {

struct Factors {
  double first, error;
};

Factors factors_after_loading(const std::vector<Override>& overrides) {
  SceneRun run("paper/onset.yaml", overrides);
  run.step();
  return {run.quantity("tips.main_first.K_II"), run.quantity("tips.main_first.K_error")};
}

// Two ways to a finer mesh: one that is fine everywhere (four times), and one that the estimate makes from a coarse
// one.
TEST(FineLevel, RefinementToAToleranceFindsWhatAFineMeshFinds) {
  const Factors coarse = factors_after_loading({{"components.tips.mesh_ratio", "1"}});
  const Factors refined =
      factors_after_loading({{"components.tips.mesh_ratio", "1"}, {"components.tips.tolerance", "1e-4"}});
  const Factors fine = factors_after_loading({{"components.tips.mesh_ratio", "0.125"}});
  EXPECT_LT(std::abs(refined.first - fine.first), 2e-4 * std::abs(fine.first));
  EXPECT_LT(refined.error, 0.5 * coarse.error);
  EXPECT_LT(coarse.error, 1e-3 * std::abs(fine.first));
}

}  // namespace
}  // namespace sprekk::testing
