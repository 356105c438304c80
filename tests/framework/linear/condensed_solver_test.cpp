// Condensation answers like the solver of the whole system, and does less.
#include "framework/linear/reduction/condensed_solver.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "tests/framework/linear/test_systems.hpp"

namespace sprekk {
namespace {

class Condensed : public testing::TestWithParam<const char*> {
 protected:
  CondensedSolver solver{[] {
    LinearOptions options;
    options.type = GetParam();
    return options;
  }()};

  Vector solve(const LinearSystem& system, const Vector& b) {
    const LinearReport factored = solver.factor(system);
    EXPECT_TRUE(factored.solved) << factored.reason;
    Vector x;
    const LinearReport solved = solver.solve(b, x);
    EXPECT_TRUE(solved.solved) << solved.reason;
    return x;
  }
};

const test::FracturedBiot biot{16};

Vector some_state() { return biot.random_state(4); }

// The system after an iteration in which other cells slide: rows on the fracture are multiplied, the bulk is the same.
LinearSystem with_other_rows_on_fractures(LinearSystem system) {
  for (int row = biot.wall_flux(0, 0); row < biot.unknowns(); ++row) system.local.row(row) *= 1.0 + row % 3;
  system.local.coeffRef(biot.wall_flux(2, 0), biot.wall_flux(2, 0)) *= 5;
  return system;
}

TEST_P(Condensed, SolvesFracturedBiot) {
  const LinearSystem system = biot.build();
  const Vector exact = some_state();
  EXPECT_LT(test::block_difference(system, solve(system, system.local * exact), exact), 1e-8);
  EXPECT_EQ(solver.name(), std::string("condensed ") + GetParam());
}

// The conditions of walls that stick: jumps of zero, which are differences of displacements that are not zero.
TEST_P(Condensed, TakesRoundOffOfJumpsThatAreZeroForNoMistake) {
  LinearSystem system = biot.build();
  std::vector<Triplet> entries;
  for (int row = 0; row < biot.unknowns(); ++row) {
    const int along = row - biot.traction(0, 0), tractions = 2 * biot.columns();
    if (along >= tractions && along < 2 * tractions) {
      // The pattern is that of walls that slide, where the balance of the walls determines the jump.
      const int other = along % 2 == 0 ? row + 1 : row - 1;
      for (const auto& [column, value] :
           {std::pair{row, -1.0}, {other, 0.3}, {row - tractions, 0}, {other - tractions, 0}})
        entries.emplace_back(row - tractions, column, value);
      continue;
    }
    const int to = along >= 0 && along < tractions ? row + tractions : row;
    for (SparseMatrix::InnerIterator entry(system.local, row); entry; ++entry)
      entries.emplace_back(to, static_cast<int>(entry.col()), entry.value());
  }
  system.local.setFromTriplets(entries.begin(), entries.end());
  Vector exact = some_state();
  exact.segment(biot.jump(0, 0), 2 * biot.columns()).setZero();
  const Vector x = solve(system, system.local * exact);
  EXPECT_EQ(solver.counts().condensed, 1);
  EXPECT_EQ(solver.counts().factorizations, 1) << "the whole system was factorized";
  const int displacements = 2 * biot.nodes();
  EXPECT_LT((x - exact).head(displacements).norm(), 1e-6 * exact.head(displacements).norm());
}

TEST_P(Condensed, ReducesANumberedSystemOnce) {
  LinearSystem first = biot.build(), second = with_other_rows_on_fractures(first);
  first.pattern_number = second.pattern_number = new_system_number();
  first.number = new_system_number();
  second.number = new_system_number();
  const Vector exact = some_state();
  for (const LinearSystem* system : {&first, &first, &second, &second, &first})
    EXPECT_LT(test::block_difference(*system, solve(*system, system->local * exact), exact), 1e-8);
  EXPECT_EQ(solver.counts().factorizations, 1);
  EXPECT_EQ(solver.counts().condensed, 3);
}

TEST_P(Condensed, FactorizesTheBulkOnceForSystemsThatDifferOnFractures) {
  const LinearSystem first = biot.build(), second = with_other_rows_on_fractures(first);
  const Vector exact = some_state();
  solve(first, first.local * exact);
  EXPECT_LT(test::block_difference(second, solve(second, second.local * exact), exact), 1e-8);
  EXPECT_EQ(solver.counts().factorizations, 1);
  EXPECT_EQ(solver.counts().condensed, 2);
  EXPECT_EQ(solver.counts().solves, 2);
  EXPECT_EQ(solver.counts().columns, 4 * biot.columns() + biot.columns());  // T, lambda, and p_f, which presses
}

TEST_P(Condensed, MakesNoBackSolveWhereOnlyFracturesAreLoaded) {
  const LinearSystem system = biot.build();
  Vector b = system.local * some_state();
  b.head(biot.first_local()).setZero();
  const Vector x = solve(system, b);
  EXPECT_EQ(solver.counts().solves, 0);
  EXPECT_LT(test::block_difference(system, solve(system, system.local * x), x), 1e-8);
}

TEST_P(Condensed, KeepsTheBulksOfTwoTimeStepsAndRepeatsItsBits) {
  test::FracturedBiot shorter = biot;
  shorter.time_step /= 100;
  const LinearSystem first = biot.build(), second = shorter.build();
  const Vector b = first.local * some_state();
  const Vector x = solve(first, b);
  solve(second, b);
  EXPECT_EQ(solve(first, b), x);
  EXPECT_EQ(solver.counts().factorizations, 2);
}

// Time steps of three sizes in turn, one of them next to another: bulks come back, are remembered or have been
// forgotten.
TEST_P(Condensed, AnswersAlikeWhicheverBulksCameBefore) {
  std::vector<LinearSystem> systems;
  for (const double factor : {1.0, 0.01, 1.0, 1 + 1e-9, 0.01, 1.0, 1.0}) {
    test::FracturedBiot other = biot;
    other.time_step *= factor;
    systems.push_back(other.build());
  }
  const Vector b = systems[0].local * some_state();
  for (const LinearSystem& system : systems) {
    LinearOptions options;
    options.type = GetParam();
    CondensedSolver fresh(options);
    Vector alone;
    ASSERT_TRUE(fresh.factor(system).solved && fresh.solve(b, alone).solved);
    EXPECT_EQ(solve(system, b), alone);
  }
  EXPECT_EQ(solver.counts().factorizations, 5);  // of two bulks that are kept, the older one makes room
}

// The Laplacian of a block that nothing holds but one spring to a local unknown.
TEST_P(Condensed, KeepsACellOfABulkThatFloats) {
  constexpr int n = 9;
  LinearSystem floating = test::poisson(n, true);
  std::vector<Triplet> entries;
  for (int row = 0; row < n * n; ++row)
    for (SparseMatrix::InnerIterator entry(floating.local, row); entry; ++entry)
      entries.emplace_back(row, entry.col(), entry.value());
  const int spring = n * n;
  entries.insert(entries.end(), {{3, spring, 1.0}, {spring, spring, 1.0}, {spring, 3, -2.0}});
  std::vector<UnknownBlock> blocks = floating.blocks;
  blocks.push_back({"spring.force", spring, 1, 1, BlockKind::interface, {}, {}});
  const LinearSystem held = test::make_system(n * n + 1, entries, blocks);
  const Vector exact = test::random_vector(n * n + 1, 5);
  EXPECT_LT((solve(held, held.local * exact) - exact).norm(), 1e-9);
  EXPECT_EQ(solver.name(), std::string("condensed ") + GetParam());
  EXPECT_EQ(solver.counts().orderings, 1);
  EXPECT_EQ(solver.counts().factorizations, 1);
}

// The same without the spring: what elimination leaves of the row of the cell is round-off, which is no stiffness.
TEST_P(Condensed, RefusesABulkThatNothingHolds) {
  constexpr int n = 9;
  const LinearSystem floating = test::poisson(n, true);
  std::vector<Triplet> entries;
  for (int row = 0; row < n * n; ++row) {
    double others = 0;
    for (SparseMatrix::InnerIterator entry(floating.local, row); entry; ++entry) {
      if (entry.col() == row) continue;
      const double conductance = 1 / (3.0 + row + entry.col());
      others += conductance;
      entries.emplace_back(row, entry.col(), -conductance);
    }
    entries.emplace_back(row, row, others);
  }
  const int local = n * n;
  entries.insert(entries.end(), {{3, local, 1.0}, {local, local, 1.0}, {local, 3, 0.0}});
  std::vector<UnknownBlock> blocks = floating.blocks;
  blocks.push_back({"sealed.flux", local, 1, 1, BlockKind::interface, {}, {}});
  const LinearReport report = solver.factor(test::make_system(n * n + 1, entries, blocks));
  EXPECT_FALSE(report.solved);
  EXPECT_NE(report.reason.find("singular"), std::string::npos) << report.reason;
}

// The Laplacian of n × n nodes, the first `count` of which are coupled to a local unknown each.
LinearSystem with_local_unknowns(int n, int count) {
  const LinearSystem bulk = test::poisson(n);
  std::vector<Triplet> entries;
  for (int row = 0; row < n * n; ++row)
    for (SparseMatrix::InnerIterator entry(bulk.local, row); entry; ++entry)
      entries.emplace_back(row, entry.col(), entry.value());
  for (int i = 0; i < count; ++i)
    entries.insert(entries.end(), {{i, n * n + i, 1.0}, {n * n + i, n * n + i, 1.0}, {n * n + i, i, -2.0}});
  std::vector<UnknownBlock> blocks = bulk.blocks;
  blocks.push_back({"springs.force", n * n, count, 1, BlockKind::interface, {}, {}});
  return test::make_system(n * n + count, entries, blocks);
}

// Like one time step after another: the bulk loses what holds it, and gets it back. Bits do not depend on the systems
// before.
TEST_P(Condensed, AnswersAlikeWhateverFloatedBefore) {
  LinearSystem held = with_local_unknowns(9, 3), floating = held;
  for (int i = 0; i < 81; ++i) {
    double others = 0;
    for (SparseMatrix::InnerIterator entry(floating.local, i); entry; ++entry)
      if (entry.col() != i && entry.col() < 81) others -= entry.value();
    floating.local.coeffRef(i, i) = others;
  }
  const Vector exact = test::random_vector(84, 9);
  for (const LinearSystem* system : {&held, &floating, &held, &floating}) {
    const Vector b = system->local * exact;
    const Vector x = solve(*system, b);
    EXPECT_LT((x - exact).norm(), 1e-9);
    LinearOptions options;
    options.type = GetParam();
    CondensedSolver fresh(options);
    Vector alone;
    ASSERT_TRUE(fresh.factor(*system).solved && fresh.solve(b, alone).solved);
    EXPECT_EQ(x, alone);
  }
}

// A bulk that comes nearer and nearer to a singular one, as the shift of its matrix approaches an eigenvalue of
// -Laplace, of a mode whose sum over rows vanishes, while local unknowns keep the whole system regular. Reference: the
// definition of the backward error.
TEST_P(Condensed, AcceptsABulkWhoseFirstSolutionOneRefinementMakesAccurate) {
  constexpr int n = 20;
  const double angle = std::numbers::pi / (n + 1), eigenvalue = 4 - 2 * std::cos(2 * angle) - 2 * std::cos(3 * angle);
  int condensed = 0;
  for (int quarters = 48; quarters <= 62; ++quarters) {
    const double shift = std::pow(10, -quarters / 4.0);
    LinearSystem system = with_local_unknowns(n, 3);
    for (int i = 0; i < n * n; ++i) system.local.coeffRef(i, i) += shift - eigenvalue;
    const Vector b = system.local * test::random_vector(system.local.cols(), 9);
    const SparseMatrix sizes = system.local.cwiseAbs();
    const auto error = [&](const Vector& x) {
      return (b - system.local * x).cwiseAbs().maxCoeff() / (sizes * x.cwiseAbs() + b.cwiseAbs()).maxCoeff();
    };
    LinearOptions options;
    options.type = GetParam();
    CondensedSolver fresh(options);
    Vector x, more;
    ASSERT_TRUE(fresh.factor(system).solved && fresh.solve(b, x).solved);
    const bool is_condensed = fresh.name() == std::string("condensed ") + GetParam();
    if (!is_condensed) {
      EXPECT_LT(error(x), 1e-12) << shift;
      continue;
    }
    ++condensed;
    ASSERT_TRUE(fresh.solve(b - system.local * x, more).solved);
    EXPECT_LT(error(x + more), 1e-9) << shift;
  }
  // A refinement squares the relative error, so half of the digits are enough in the solution with the bulk.
  EXPECT_GE(condensed, 6);
  EXPECT_LE(condensed, 12);
}

// 144 columns of 400 unknowns: more than 7 sqrt(400).
TEST_P(Condensed, TakesTheWholeSystemWhereTheReducedOneWouldCostMore) {
  const LinearSystem system = with_local_unknowns(20, 144);
  const Vector exact = test::random_vector(system.local.cols(), 7);
  for (int i = 0; i < 4; ++i) EXPECT_LT((solve(system, system.local * exact) - exact).norm(), 1e-9);
  EXPECT_EQ(solver.name(), GetParam());
  EXPECT_EQ(solver.counts().columns, 0);
}

// 420 columns cost 2.1 factorizations, and a system saves 1 - (420 / (7 * 70))^3 = 0.37 of one: 5.7 systems.
TEST_P(Condensed, WaitsUntilTheBulkHasStayedForWhatItsColumnsCost) {
  LinearSystem system = with_local_unknowns(70, 420);
  const int last = static_cast<int>(system.local.cols()) - 1;
  for (int i = 0; i < 5; ++i) {
    system.local.coeffRef(last, last) += 1;
    EXPECT_TRUE(solver.factor(system).solved);
  }
  EXPECT_EQ(solver.name(), GetParam());
  EXPECT_EQ(solver.counts().columns, 0);
  const Vector exact = test::random_vector(system.local.cols(), 8);
  system.local.coeffRef(last, last) += 1;
  EXPECT_LT((solve(system, system.local * exact) - exact).norm(), 1e-9);
  EXPECT_EQ(solver.name(), std::string("condensed ") + GetParam());
  EXPECT_EQ(solver.counts().columns, 420);
}

// Where factors fill as in space they cost 0.6 factorizations, and a system saves nearly a whole one.
TEST_P(Condensed, TakesABulkAtOnceWhereFactorsFillMore) {
  LinearOptions options;
  options.type = GetParam();
  options.condensing = {.columns = 700, .columns_at_once = 700, .width = 5, .power = 2.0 / 3};
  CondensedSolver in_space(options);
  const LinearSystem system = with_local_unknowns(70, 420);
  const Vector exact = test::random_vector(system.local.cols(), 9);
  Vector x;
  ASSERT_TRUE(in_space.factor(system).solved && in_space.solve(system.local * exact, x).solved);
  EXPECT_LT((x - exact).norm(), 1e-9);
  EXPECT_EQ(in_space.counts().columns, 420);
}

// As in an iteration in which all walls around a block are open: the next one has the same pattern.
TEST_P(Condensed, KeepsTheOrderingOfAWholeSystemThatWasSingular) {
  LinearOptions options;
  options.type = GetParam();
  const auto whole = make_linear_solver(options);
  LinearSystem system = test::poisson(20, true);
  const Vector exact = test::random_vector(400, 10);
  for (int iteration = 0; iteration < 4; ++iteration) {
    const bool is_singular = iteration % 2 == 0;
    system.local.coeffRef(7, 7) += is_singular ? -iteration : iteration + 1;
    ASSERT_EQ(whole->factor(system).solved, !is_singular);
    if (is_singular) continue;
    Vector x;
    ASSERT_TRUE(whole->solve(system.local * exact, x).solved);
    EXPECT_LT((x - exact).norm(), 1e-9);
  }
  EXPECT_EQ(whole->counts().orderings, 1);
  EXPECT_EQ(whole->counts().factorizations, 4);
}

TEST_P(Condensed, PassesSystemsWithoutFracturesOn) {
  const LinearSystem system = test::poisson(20);
  const Vector exact = test::random_vector(400, 6);
  EXPECT_LT((solve(system, system.local * exact) - exact).norm(), 1e-9);
  EXPECT_EQ(solver.name(), GetParam());
}

INSTANTIATE_TEST_SUITE_P(Types, Condensed, testing::Values("umfpack", "mumps"),
                         [](const auto& info) { return std::string(info.param); });

}  // namespace
}  // namespace sprekk
