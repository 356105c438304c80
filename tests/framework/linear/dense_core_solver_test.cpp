#include "framework/linear/direct/dense_core_solver.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "tests/framework/linear/test_systems.hpp"

namespace sprekk::test {
namespace {

/// A straight crack of `cells` elements of length 2 with constant jumps (displacement discontinuities) in an elastic
/// plane, G/(1 − nu) = 1: stresses at walls t = −1/pi sum_j D_j/((x_i − x_j)^2 − 1) (Crouch 1976), which the traction
/// of the law equals. Elements beyond `slipping` from the middle are held, the others have the traction that is given.
LinearSystem crack(int cells, int slipping, bool reversed = false, double factor = 1) {
  std::vector<Triplet> entries;
  const auto jump = [=](int i) { return reversed ? cells - 1 - i : i; };
  const auto traction = [=](int i) { return cells + i; };
  const auto wall = [=](int i) { return 2 * cells + i; };
  for (int i = 0; i < cells; ++i) {
    entries.emplace_back(wall(i), wall(i), 1);
    for (int j = 0; j < cells; ++j)
      entries.emplace_back(wall(i), jump(j), factor / std::numbers::pi / (4.0 * (i - j) * (i - j) - 1));
    entries.emplace_back(jump(i), traction(i), 1);
    entries.emplace_back(jump(i), wall(i), -1);
    const bool slips = std::abs(2 * i + 1 - cells) < slipping;
    entries.emplace_back(traction(i), traction(i), slips ? 1 : 0);
    entries.emplace_back(traction(i), jump(i), slips ? 0 : 1);
  }
  return make_system(3 * cells, entries,
                     {{"contact.jump", 0, cells, 1, BlockKind::interface, {}, {}},
                      {"contact.traction", cells, cells, 1, BlockKind::interface, {}, {}},
                      {"rock.wall_traction", 2 * cells, cells, 1, BlockKind::interface, {}, {}}});
}

/// The jumps under a stress of 1 on all that slips.
Vector jumps(DenseCoreSolver& solver, const LinearSystem& system, int cells) {
  EXPECT_TRUE(solver.factor(system).solved);
  Vector load = Vector::Zero(3 * cells), x;
  for (int i = 0; i < cells; ++i)
    if (system.local.coeff(cells + i, cells + i) == 1) load[cells + i] = 1;
  EXPECT_TRUE(solver.solve(load, x).solved);
  EXPECT_LT((load - system.local * x).lpNorm<Eigen::Infinity>(), 1e-12 * x.lpNorm<Eigen::Infinity>());
  return x.head(cells);
}

// D = 2 sqrt(c^2 − x^2). Elements of constant jumps act as a crack whose ends lie a quarter of an element farther out,
// so c = `slipping` + 1/2, up to the square of the size of elements.
TEST(DenseCore, SolvesForTheCrackThatSlipsAndHasItsSize) {
  for (const auto& [cells, slipping] : {std::pair{200, 200}, {200, 100}, {400, 100}}) {
    DenseCoreSolver solver;
    const Vector d = jumps(solver, crack(cells, slipping), cells);
    EXPECT_NEAR(d[cells / 2] / (2 * std::sqrt(std::pow(slipping + 0.5, 2) - 1)), 1, 0.15 / slipping / slipping);
    EXPECT_EQ(solver.core_size(), slipping);
    EXPECT_EQ(solver.name(), "dense core");
    DenseCoreSolver turned, perturbed;
    const Vector other = jumps(turned, crack(cells, slipping, true), cells);
    EXPECT_LT((other.reverse() - d).norm(), 1e-11 * d.norm());
    const Vector near = jumps(perturbed, crack(cells, slipping, false, 1 + 1e-9), cells);
    EXPECT_LT((near * (1 + 1e-9) - d).norm(), 1e-11 * d.norm());
  }
}

TEST(DenseCore, NamesWhatNothingDetermines) {
  DenseCoreSolver solver;
  LinearSystem system = crack(240, 240);
  for (int i = 0; i < 240; ++i) system.local.coeffRef(480 + i, 7) = system.local.coeff(480 + i, 8);  // D_7 + D_8 alone
  const LinearReport report = solver.factor(system);
  EXPECT_FALSE(report.solved);
  EXPECT_NE(report.reason.find("contact.jump, entity"), std::string::npos) << report.reason;
}

TEST(DenseCore, LeavesSparseSystemsToUmfpack) {
  DenseCoreSolver solver;
  const LinearSystem system = poisson(120);
  ASSERT_TRUE(solver.factor(system).solved);
  EXPECT_EQ(solver.name(), "umfpack");
  const Vector exact = random_vector(14400, 1);
  Vector x;
  ASSERT_TRUE(solver.solve(system.local * exact, x).solved);
  EXPECT_LT((x - exact).norm(), 1e-11 * exact.norm());
}

// Rows that cancel: a leading pair of nearly equal rows leaves 1e-9 of the second, whose multiples would be large.
TEST(DenseCore, DoesNotDivideByWhatIsLeftOfRowsThatCancel) {
  LinearSystem system = crack(240, 240);
  system.local.coeffRef(240, 241) = 1;
  system.local.coeffRef(241, 240) = 1 + 1e-9;
  system.local.makeCompressed();
  DenseCoreSolver solver;
  ASSERT_TRUE(solver.factor(system).solved);
  EXPECT_EQ(solver.name(), "dense core");
  const Vector exact = random_vector(720, 2);
  Vector x;
  ASSERT_TRUE(solver.solve(system.local * exact, x).solved);
  EXPECT_LT((system.local * (x - exact)).lpNorm<Eigen::Infinity>(), 1e-13);
}

}  // namespace
}  // namespace sprekk::test
