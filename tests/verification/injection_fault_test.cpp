// Slip driven by injection into a frictional fault (Viesca 2021).
#include <gtest/gtest.h>

#include <cmath>

#include "tests/verification/scene_run.hpp"

namespace sprekk::testing {
namespace {

const std::string references = std::string(SPREKK_SOURCE_DIR) + "/tests/verification/references/";

/// lambda(T) of the table, linear between its rows.
double front(double load) {
  const auto rows = read_numbers(references + "viesca2021_T_lambda.csv");
  for (std::size_t i = 1; i < rows.size(); ++i)
    if (load <= rows[i][0])
      return rows[i - 1][1] + (load - rows[i - 1][0]) / (rows[i][0] - rows[i - 1][0]) * (rows[i][1] - rows[i - 1][1]);
  return 0;
}

struct Slip {
  double front, at_centre, cell;  ///< m
};

Slip run_fault(const std::string& shear, double time) {
  SceneRun run("verification/injection_fault.yaml",
               {{"components.rock.initial_stress.xy", shear}, {"time.end", std::to_string(time) + " s"}});
  run.run();
  Slip slip{0, 0, run.mesh().fracture_cells[0].measure};
  for (int i = 0; i < run.mesh().fracture_cell_count(); ++i)
    slip.at_centre = std::max(slip.at_centre, std::abs(run.field("contact.jump")[2 * i + 1]));
  for (int i = 0; i < run.mesh().fracture_cell_count(); ++i)
    // What sticks moves by round-off.
    if (std::abs(run.field("contact.jump")[2 * i + 1]) > 1e-9 * slip.at_centre)
      slip.front = std::max(slip.front, run.mesh().fracture_cells[i].center[0] + 0.5 * slip.cell);
  return slip;
}

// T = (f s' - tau)/(f dp) with f = 0.5, s' = 10 MPa, dp = 4 MPa: tau = 4 MPa gives 0.5, 4.6 MPa gives 0.2.
struct Case {
  const char* shear;
  double load, time;
  int profile_column;
};

TEST(InjectionFault, FrontAndSlipFollowViesca) {
  for (const Case& c : {Case{"4 MPa", 0.5, 0.5, 2}, Case{"4.6 MPa", 0.2, 0.25, 1}}) {
    const Slip slip = run_fault(c.shear, c.time);
    const double a = front(c.load) * std::sqrt(4 * c.time);
    EXPECT_NEAR(slip.front / a, 1, 0.05) << c.load;  // one or two cells of 0.05 m, and backward Euler
    // delta(0) E'/(f dp a) of the profiles' first row.
    const double plane_modulus = 10e9 / (1 - 0.0625);
    const double expected =
        read_numbers(references + "viesca2021_slip_profiles.csv")[0][c.profile_column] * 0.5 * 4e6 * a / plane_modulus;
    EXPECT_NEAR(slip.at_centre / expected, 1, 0.05) << c.load;
  }
}

}  // namespace
}  // namespace sprekk::testing
