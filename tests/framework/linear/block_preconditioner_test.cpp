// The block preconditioner and its elimination of fracture unknowns, in one process.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <Eigen/LU>

#include "framework/linear/iterative/local_elimination.hpp"
#include "tests/framework/linear/test_systems.hpp"

namespace sprekk {
namespace {

Vector physical_load(const test::FracturedBiot& problem) {
  Vector b = Vector::Zero(problem.unknowns());
  for (int i = 0; i < problem.columns(); ++i) {
    b[problem.displacement(problem.node(1, i, problem.n / 2), 0)] = problem.young * 1e-4;  // the top is sheared
    b[problem.fracture_pressure(i)] = 1e-5 / problem.n;                                    // injected volume
  }
  return b;
}

int iterations(const LinearSystem& system, const Vector& b) {
  LinearOptions options;
  options.type = "belos";
  options.tolerance = 1e-8;
  const auto solver = make_linear_solver(options);
  const LinearReport factored = solver->factor(system);
  EXPECT_TRUE(factored.solved) << factored.reason;
  Vector x;
  const LinearReport report = solver->solve(b, x);
  EXPECT_TRUE(report.solved) << report.reason;
  return report.iterations;
}

TEST(BlockPreconditioner, IterationsHardlyGrowWithTheSizeOfFracturedBiot) {
  const test::FracturedBiot coarse{32}, fine{64};
  const int few = iterations(coarse.build(), physical_load(coarse));
  const int more = iterations(fine.build(), physical_load(fine));
  EXPECT_GT(few, 0);
  EXPECT_LE(more, 1.5 * few) << few << " iterations at " << coarse.unknowns() << " unknowns";
  RecordProperty("iterations_coarse", few);
  RecordProperty("iterations_fine", more);
}

TEST(BlockPreconditioner, IterationsHardlyGrowWithTheSizeOfPoisson) {
  const int few = iterations(test::poisson(40), Vector::Ones(1600));
  const int more = iterations(test::poisson(80), Vector::Ones(6400));
  EXPECT_LE(more, 1.5 * few);
  EXPECT_LE(few, 15);
}

// A fracture that carries flow much better or much worse than the rock must not spoil it.
TEST(BlockPreconditioner, IterationsStayModerateOverFractureAndRockMobility) {
  for (const double fracture_mobility : {1e-14, 1e-10, 1e-6})
    for (const double mobility : {1e-17, 1e-13}) {
      test::FracturedBiot problem{32};
      problem.fracture_mobility = fracture_mobility;
      problem.mobility = mobility;
      EXPECT_LE(iterations(problem.build(), physical_load(problem)), 80) << fracture_mobility << " " << mobility;
    }
}

TEST(BlockPreconditioner, SaysWhyFractureUnknownsCannotBeEliminated) {
  const test::FracturedBiot problem{8};
  LinearSystem system = problem.build();
  for (int row = problem.first_local(); row < problem.unknowns();
       ++row)  // an unknown on which no row of its kind depends
    for (SparseMatrix::InnerIterator entry(system.local, row); entry; ++entry)
      if (entry.col() == problem.traction(1, 0)) entry.valueRef() = 0;
  LinearOptions options;
  options.type = "belos";
  const LinearReport report = make_linear_solver(options)->factor(system);
  EXPECT_FALSE(report.solved);
  EXPECT_THAT(report.reason, testing::HasSubstr("cannot eliminate the unknowns on the fractures"));
}

// Where the local unknowns couple within their cell only, the correction is the Schur complement itself.
TEST(LocalElimination, CorrectionIsTheSchurComplementWhenFractureCellsAreIndependent) {
  test::FracturedBiot problem{4};
  problem.fracture_mobility = 0;
  const LinearSystem system = problem.build();
  const Partition partition(system);
  ASSERT_EQ(partition.parts.size(), 3u);
  EXPECT_EQ(partition.parts[0].block.name, "pore.pressure");
  EXPECT_EQ(partition.parts[1].block.name, "rock.displacement");
  LocalElimination elimination(system, partition);
  ASSERT_TRUE(elimination.factor(system, partition, {}).solved);

  const Eigen::MatrixXd a = system.local.toDense();
  const int bulk = 2 * problem.nodes(), first = problem.first_local(), local = problem.unknowns() - first;
  const Eigen::MatrixXd expected =
      -a.block(0, first, bulk, local) *
      a.block(first, first, local, local).partialPivLu().solve(a.block(first, 0, local, bulk));
  const Eigen::MatrixXd correction = elimination.correction(system, partition, 1).toDense();
  EXPECT_LT((correction - expected).cwiseAbs().maxCoeff(), 1e-10 * expected.cwiseAbs().maxCoeff());
  EXPECT_GT(expected.cwiseAbs().maxCoeff(), problem.young / 10);
}

TEST(LocalElimination, SolvesTheLocalBlockExactly) {
  const test::FracturedBiot problem{8};
  const LinearSystem system = problem.build();
  const Partition partition(system);
  LocalElimination elimination(system, partition);
  ASSERT_TRUE(elimination.factor(system, partition, {}).solved);
  const int first = problem.first_local(), local = problem.unknowns() - first;
  Vector exact = test::random_vector(local, 5);
  exact.head(2 * problem.columns()) *= 1e6;
  exact.tail(problem.columns()) *= 1e6;
  Vector x = system.local.block(first, first, local, local) * exact;
  elimination.solve(x);
  for (int k = 0; k < local; ++k) EXPECT_NEAR(x[k], exact[k], 1e-8 * std::abs(exact[k]) + 1e-12) << k;
}

// Unknowns that no block names are treated as local ones.
TEST(LocalElimination, TakesUnknownsThatNoBlockNames) {
  LinearSystem system = test::poisson(6);
  system.blocks.front().entities = 30;
  system.blocks.front().coordinates.conservativeResize(2, 30);
  const Partition partition(system);
  EXPECT_EQ(partition.local().unknowns.size(), 6u);
  const Vector exact = test::random_vector(36, 1);
  LinearOptions options;
  options.type = "belos";
  const auto solver = make_linear_solver(options);
  ASSERT_TRUE(solver->factor(system).solved);
  Vector x;
  EXPECT_TRUE(solver->solve(system.local * exact, x).solved);
  EXPECT_LT((x - exact).norm(), 1e-8);
}

}  // namespace
}  // namespace sprekk
