// Distributed rows give the answer that all rows on one process give.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <stdexcept>

#include "framework/linear/direct/umfpack_solver.hpp"
#include "framework/linear/linear_solver.hpp"
#include "framework/parallel/parallel.hpp"
#include "tests/framework/linear/test_systems.hpp"

namespace sprekk {
namespace {

class DistributedSolve : public testing::TestWithParam<const char*> {
 protected:
  std::unique_ptr<LinearSolver> make() const {
    LinearOptions options;
    options.type = GetParam();
    options.tolerance = 1e-12;
    return make_linear_solver(options);
  }
  LinearSystem mine(const LinearSystem& whole) const { return test::strip(whole, parallel::rank(), parallel::size()); }
};

TEST_P(DistributedSolve, EqualsTheKnownSolutionOfPoisson) {
  const LinearSystem whole = test::poisson(90);  // large enough for several levels
  const Vector exact = test::random_vector(8100, 1);
  const LinearSystem system = mine(whole);
  const auto solver = make();
  const LinearReport factored = solver->factor(system);
  ASSERT_TRUE(factored.solved) << factored.reason;
  Vector x;
  const LinearReport report = solver->solve(test::rows_of(system, whole.local * exact), x);
  EXPECT_TRUE(report.solved) << report.reason;
  EXPECT_LT((x - exact).lpNorm<Eigen::Infinity>(), 1e-9);
}

// The reference: UMFPACK on whole rows. Every process gives it the same system, so its collective calls agree.
TEST_P(DistributedSolve, EqualsTheSolutionOfOneProcessForFracturedBiot) {
  const test::FracturedBiot problem{40};
  const LinearSystem whole = problem.build();
  Vector b = Vector::Zero(problem.unknowns());
  for (int i = 0; i < problem.columns(); ++i) {
    b[problem.displacement(problem.node(1, i, problem.n / 2), 0)] = problem.young * 1e-4;
    b[problem.fracture_pressure(i)] = 1e-5 / problem.n;
  }
  UmfpackSolver direct;
  ASSERT_TRUE(direct.factor(whole).solved);
  Vector expected = b;
  direct.solve_unchecked(expected);
  Vector correction = b - whole.local * expected;
  direct.solve_unchecked(correction);
  expected += correction;

  const LinearSystem system = mine(whole);
  const auto solver = make();
  const LinearReport factored = solver->factor(system);
  ASSERT_TRUE(factored.solved) << factored.reason;
  Vector x;
  const LinearReport report = solver->solve(test::rows_of(system, b), x);
  ASSERT_TRUE(report.solved) << report.reason;
  EXPECT_LT(test::block_difference(whole, x, expected), 1e-9);
  EXPECT_LE(report.iterations, 60);
}

TEST_P(DistributedSolve, EveryProcessHearsOfAnEmptyRow) {
  LinearSystem whole = test::poisson(10);
  whole.local.row(57) *= 0.0;
  const LinearReport report = make()->factor(mine(whole));
  EXPECT_FALSE(report.solved);
  EXPECT_THAT(report.reason, testing::HasSubstr("pore.pressure, entity 57"));
}

TEST_P(DistributedSolve, ReusesOnlyWhenNoProcessHasANewRow) {
  LinearSystem whole = test::poisson(30);
  const auto solver = make();
  ASSERT_TRUE(solver->factor(mine(whole)).solved);
  ASSERT_TRUE(solver->factor(mine(whole)).solved);
  EXPECT_EQ(solver->counts().reused, 1);
  whole.local.coeffRef(0, 0) *= 2;  // a row of the first process
  ASSERT_TRUE(solver->factor(mine(whole)).solved);
  EXPECT_EQ(solver->counts().reused, 1);
  EXPECT_EQ(solver->counts().factorizations, 2);
}

INSTANTIATE_TEST_SUITE_P(Types, DistributedSolve, testing::Values("mumps", "belos", "auto"),
                         [](const auto& info) { return std::string(info.param); });

// A constant mode that storage alone determines, 1e-21 of what is exchanged, while the rows that exchange are on
// different processes.
TEST(SummedBalances, HoldsTheLevelAcrossProcesses) {
  const test::Exchange problem{30, 1e-14, 1.0};
  const LinearSystem whole = problem.build(), system = test::strip(whole, parallel::rank(), parallel::size());
  LinearOptions options;
  options.type = "mumps";
  const auto solver = make_linear_solver(options);
  const LinearReport factored = solver->factor(system);
  ASSERT_TRUE(factored.solved) << factored.reason;
  Vector x;
  const LinearReport solved = solver->solve(test::rows_of(system, problem.right_hand_side()), x);
  ASSERT_TRUE(solved.solved) << solved.reason;
  EXPECT_LT((x - problem.solution()).head(30).lpNorm<Eigen::Infinity>(),
            1e-9 * problem.solution().head(30).lpNorm<Eigen::Infinity>());
}

TEST(Parallel, SumsMaximaAndGathersInOrderOfRank) {
  const int rank = parallel::rank(), size = parallel::size();
  ASSERT_GT(size, 1);
  EXPECT_EQ(parallel::is_root(), rank == 0);
  EXPECT_EQ(parallel::sum(rank + 1.0), size * (size + 1) / 2.0);
  EXPECT_EQ(parallel::max(-1.0 - rank), -1);
  EXPECT_TRUE(parallel::any(rank == size - 1));
  EXPECT_FALSE(parallel::any(false));
  Vector values = Vector::Zero(size);
  values[rank] = rank;
  parallel::sum(values);
  EXPECT_EQ(values, Vector::LinSpaced(size, 0, size - 1));
  const std::vector<int> all = parallel::gather(std::vector<int>(rank + 1, rank));
  ASSERT_EQ(all.size(), static_cast<std::size_t>(size * (size + 1) / 2));
  EXPECT_TRUE(std::is_sorted(all.begin(), all.end()));
  EXPECT_EQ(std::count(all.begin(), all.end(), size - 1), size);
}

}  // namespace
}  // namespace sprekk
