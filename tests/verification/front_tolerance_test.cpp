// What a scene gains and loses by a larger tolerance of growth within steps.
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <string>

#include "framework/assembly/notes.hpp"
#include "tests/verification/scene_run.hpp"
#include "tests/verification/values_of_paper.hpp"

namespace sprekk::testing {
namespace {

constexpr double hour = 3600;  // s

/// The first wings of section 5.2 of the paper.
struct Wings {
  double load, shear;  ///< the largest |ln(mean of both K/K_IC)| and |K_II/K_I| after a step
  double length;       ///< m, of both together in the end
  double evaluations;  ///< of steps, with an advance

  Wings(const std::string& angle, const std::string& tolerance) : load(0), shear(0) {
    SceneRun run("paper/wing_cracks.yaml",
                 with_values_of_paper({{"geometry.fractures.main.angle", angle},
                                       {"components.tips.growth.front_tolerance", tolerance}}));
    const auto of = [&](const std::string& name) {
      return std::array{run.quantity("tips.main_first." + name), run.quantity("tips.main_last." + name)};
    };
    run.run_until(5 * hour, [&] {
      const auto grows = of("grows"), advance = of("speed"), k1 = of("K_I"), k2 = of("K_II"),
                 apparent = of("apparent_toughness");
      if (grows[0] != 1 || grows[1] != 1 || run.time() < hour) return;
      // Of several tips the mean of their loads is found, each by its advance.
      double sum = 0;
      for (int i = 0; i < 2; ++i) {
        sum += advance[i] * (std::hypot(k1[i], k2[i]) / apparent[i] - 1);
        shear = std::max(shear, std::abs(k2[i] / k1[i]));
      }
      load = std::max(load, std::abs(sum / (advance[0] + advance[1])));
    });
    length = of("length")[0] + of("length")[1];
    evaluations = static_cast<double>(run.trials());
  }
};

std::size_t notes_with(const std::string& update, const std::string& parameter) {
  SceneRun run("paper/wing_cracks.yaml",
               with_values_of_paper({{"schedule.1.update", update}, {"components.tips.growth." + parameter, "1e-5"}}));
  Notes notes;
  for (const Part* part : run.model().parts()) part->note_input(notes);
  return notes.all().size();
}

TEST(FrontToleranceAlone, IsSaidToHaveNoEffectAfterSteps) {
  EXPECT_EQ(notes_with("after_step", "front_tolerance"), 1u);
  EXPECT_EQ(notes_with("within_step", "front_tolerance"), 0u);
  EXPECT_EQ(notes_with("after_step", "arrest_tolerance"), 0u);
  SceneRun resting("paper/wing_cracks.yaml", {{"schedule", "[{solve: [pore, rock, conduit, contact]}]"},
                                              {"components.tips.growth.front_tolerance", "1e-5"}});
  Notes notes;
  for (const Part* part : resting.model().parts()) part->note_input(notes);
  EXPECT_EQ(notes.all().size(), 1u);
}

class FrontTolerance : public ::testing::TestWithParam<const char*> {};

TEST_P(FrontTolerance, IsWhatALargerOneAllows) {
  const Wings tight(GetParam(), "1e-7"), loose(GetParam(), "1e-4");
  EXPECT_LT(tight.load, 2e-7);
  EXPECT_LT(tight.shear, 1e-6);
  EXPECT_LT(loose.load, 2e-4);
  EXPECT_LT(loose.shear, 1e-3);
  EXPECT_GT(loose.load + loose.shear, 1e-6);
  EXPECT_LT(loose.evaluations, 0.85 * tight.evaluations);
  // ln K falls by 0.02 per mm of each wing or faster.
  EXPECT_NEAR(loose.length, tight.length, 2 * 1e-4 / 0.02e3);
}

INSTANTIATE_TEST_SUITE_P(Angles, FrontTolerance, ::testing::Values("45 deg", "-45 deg"));

}  // namespace
}  // namespace sprekk::testing
