// Which solutions of a direct solver are accepted.
#include "framework/linear/refined_solve.hpp"

#include <gtest/gtest.h>

#include "tests/framework/linear/test_systems.hpp"

namespace sprekk {
namespace {

/// Solves with the identity by a solver whose first solution is longer than the right one by the share `error`, and
/// which has nothing to add to it afterwards.
LinearReport solve_with_error(double error) {
  constexpr int n = 20;
  std::vector<Triplet> entries;
  for (int i = 0; i < n; ++i) entries.emplace_back(i, i, 1);
  const LinearSystem system = test::make_system(n, entries, {{"pore.pressure", 0, n, 1, BlockKind::interface, {}, {}}});
  const Equilibrated scaled = equilibrate(system);
  bool is_first = true;
  const auto apply_inverse = [&](Vector& y) {
    y *= is_first ? 1 + error : 0;
    is_first = false;
  };
  Vector x;
  return refined_solve(system, scaled, Vector::Ones(n), apply_inverse, x);
}

// With A = I and y = (1 + e) b the backward error |r| / (|A| |y| + |b|) is e / (2 + e), and the relative residual is e.
TEST(RefinedSolve, RefusesSolutionsWithABackwardErrorAboveTheAcceptableOne) {
  for (const double accepted : {0.0, 1e-14, 1e-12, 1.5e-10}) {
    const LinearReport report = solve_with_error(accepted);
    EXPECT_TRUE(report.solved) << accepted << ": " << report.reason;
    EXPECT_NEAR(report.relative_residual, accepted, 1e-15);
  }
  for (const double refused : {2.5e-10, 1e-8, 1e-2, 10.0}) {
    const LinearReport report = solve_with_error(refused);
    EXPECT_FALSE(report.solved) << refused;
    EXPECT_NE(report.reason.find("singular to working precision"), std::string::npos) << report.reason;
    EXPECT_NEAR(report.relative_residual, refused, 1e-15 * (1 + refused));
  }
}

}  // namespace
}  // namespace sprekk
