// What every linear solver of one process promises.
#include "framework/linear/linear_solver.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <Eigen/Dense>
#include <limits>
#include <numbers>
#include <stdexcept>

#include "framework/linear/direct/kept_orderings.hpp"
#include "tests/framework/linear/test_systems.hpp"

namespace sprekk {
namespace {

using testing::HasSubstr;

class EveryLinearSolver : public testing::TestWithParam<const char*> {
 protected:
  std::unique_ptr<LinearSolver> make() const {
    LinearOptions options;
    options.type = GetParam();
    options.tolerance = 1e-12;
    return make_linear_solver(options);
  }
};

class EveryDirectSolver : public EveryLinearSolver {};

Vector solve(LinearSolver& solver, const LinearSystem& system, const Vector& b) {
  const LinearReport factored = solver.factor(system);
  EXPECT_TRUE(factored.solved) << factored.reason;
  Vector x;
  const LinearReport solved = solver.solve(b, x);
  EXPECT_TRUE(solved.solved) << solved.reason;
  return x;
}

// The discrete eigenvector sin(pi x) sin(2 pi y) of the five-point Laplacian, with its eigenvalue.
TEST_P(EveryLinearSolver, SolvesPoissonExactlyForADiscreteEigenvector) {
  constexpr int n = 40;
  const LinearSystem system = test::poisson(n);
  const double h = std::numbers::pi / (n + 1);
  const double eigenvalue = 4 * std::pow(std::sin(h / 2), 2) + 4 * std::pow(std::sin(h), 2);
  Vector exact(n * n);
  for (int k = 0; k < n * n; ++k) exact[k] = std::sin(h * (k % n + 1)) * std::sin(2 * h * (k / n + 1));
  const Vector x = solve(*make(), system, eigenvalue * exact);
  EXPECT_LT((x - exact).lpNorm<Eigen::Infinity>(), 1e-9);
}

// GMRES is to have a residual below round-off, which it cannot: 'belos' says so.
TEST(AutomaticSolver, SolvesDirectlyWhereGmresDoesNotConverge) {
  constexpr int n = 300;
  LinearOptions options;
  options.tolerance = 1e-18;
  options.largest_for_direct = n / 3;
  options.largest_for_direct_instead = n;
  const auto automatic = make_linear_solver(options);
  for (const int seed : {7, 9}) {
    const LinearSystem system = test::random_dominant(n, seed);
    for (const int of : {8, 10}) {
      const Vector exact = test::random_vector(n, of), b = system.local * exact;
      EXPECT_LT((solve(*automatic, system, b) - exact).lpNorm<Eigen::Infinity>(), 1e-11);
      options.type = "belos";
      const auto alone = make_linear_solver(options);
      Vector x;
      EXPECT_TRUE(alone->factor(system).solved);
      EXPECT_THAT(alone->solve(b, x).reason, HasSubstr("GMRES did not converge"));
    }
  }
  EXPECT_EQ(automatic->name(), "belos");
  EXPECT_EQ(automatic->counts().solves, 6);  // one by GMRES and two directly for each system
}

TEST(AutomaticSolver, LeavesFarLargerSystemsToGmres) {
  constexpr int n = 300;
  for (const int instead : {0, n - 1}) {
    LinearOptions options;
    options.tolerance = 1e-18;
    options.largest_for_direct = n / 6;
    options.largest_for_direct_instead = instead;
    const auto automatic = make_linear_solver(options);
    const LinearSystem system = test::random_dominant(n, 7);
    Vector x;
    EXPECT_TRUE(automatic->factor(system).solved);
    EXPECT_THAT(automatic->solve(system.local * test::random_vector(n, 8), x).reason,
                HasSubstr("GMRES did not converge"));
  }
}

TEST_P(EveryLinearSolver, SolvesANonsymmetricSystem) {
  constexpr int n = 300;
  const LinearSystem system = test::random_dominant(n, 7);
  const Vector exact = test::random_vector(n, 8);
  const Vector x = solve(*make(), system, system.local * exact);
  EXPECT_LT((x - exact).lpNorm<Eigen::Infinity>(), 1e-11);
}

TEST_P(EveryLinearSolver, SolvesASystemWithRowsAndColumnsOfAllSizes) {
  constexpr int n = 300;
  LinearSystem system = test::random_dominant(n, 9);
  const Vector rows = (12 * std::log(10.0) * test::random_vector(n, 10)).array().exp();
  const Vector columns = (12 * std::log(10.0) * test::random_vector(n, 11)).array().exp();
  system.local = rows.asDiagonal() * system.local * columns.asDiagonal();
  const Vector y = test::random_vector(n, 12);
  const Vector exact = y.cwiseQuotient(columns);
  const Vector x = solve(*make(), system, system.local * exact);
  EXPECT_LT((x - exact).cwiseProduct(columns).lpNorm<Eigen::Infinity>(), 1e-10);
}

TEST_P(EveryLinearSolver, GivesZeroForZero) {
  const Vector x = solve(*make(), test::poisson(10), Vector::Zero(100));
  EXPECT_EQ(x.norm(), 0);
}

TEST_P(EveryLinearSolver, NamesTheUnknownOfAnEmptyRowOrColumn) {
  LinearSystem system = test::poisson(10);
  system.local.row(57) *= 0.0;
  const LinearReport report = make()->factor(system);
  EXPECT_FALSE(report.solved);
  EXPECT_THAT(report.reason, HasSubstr("the row of pore.pressure, entity 57 is zero"));

  system = test::poisson(10);
  for (int row = 0; row < 100; ++row)
    for (SparseMatrix::InnerIterator entry(system.local, row); entry; ++entry)
      if (entry.col() == 31) entry.valueRef() = 0;
  EXPECT_THAT(make()->factor(system).reason, HasSubstr("nothing determines pore.pressure, entity 31"));
}

TEST_P(EveryLinearSolver, RefusesWhatIsNotANumber) {
  LinearSystem system = test::poisson(10);
  const auto solver = make();
  Vector b = Vector::Ones(100), x;
  ASSERT_TRUE(solver->factor(system).solved);
  b[3] = std::nan("");
  EXPECT_THAT(solver->solve(b, x).reason, HasSubstr("right-hand side has an entry that is not a finite number"));
  system.local.coeffRef(12, 12) = std::nan("");
  EXPECT_THAT(solver->factor(system).reason, HasSubstr("row of pore.pressure, entity 12"));
}

TEST_P(EveryLinearSolver, RecoversAfterASystemThatItRefused) {
  const auto solver = make();
  LinearSystem system = test::poisson(10);
  const LinearSystem good = system;
  system.local.row(57) *= 0.0;
  EXPECT_FALSE(solver->factor(system).solved);
  EXPECT_FALSE(solver->factor(system).solved);
  const Vector exact = test::random_vector(100, 1);
  EXPECT_LT((solve(*solver, good, good.local * exact) - exact).norm(), 1e-9);
}

TEST_P(EveryLinearSolver, DoesNothingForTheSameSystemAgain) {
  const auto solver = make();
  const LinearSystem system = test::poisson(20);
  const Vector b = test::random_vector(400, 2);
  const Vector first = solve(*solver, system, b);
  const Vector second = solve(*solver, system, b);
  EXPECT_EQ(first, second);
  EXPECT_EQ(solver->counts().factorizations, 1);
  EXPECT_EQ(solver->counts().reused, 1);
  EXPECT_EQ(solver->counts().solves, 2);
}

// What a solver did before must not show: a rewound time step repeats its bits.
TEST_P(EveryLinearSolver, RepeatsItsBitsWhateverItSolvedBefore) {
  const LinearSystem system = test::FracturedBiot{8}.build();
  const Vector b = system.local * test::random_vector(static_cast<int>(system.local.rows()), 3);
  const auto fresh = make(), used = make();
  LinearSystem other = system;
  other.local *= 1.5;
  other.local.coeffRef(0, 0) *= 3;
  solve(*used, test::poisson(10), Vector::Ones(100));
  solve(*used, other, b);
  const Vector expected = solve(*fresh, system, b);
  EXPECT_EQ(solve(*used, system, b), expected);
}

// The difference is of each block by its own size.
TEST_P(EveryLinearSolver, SolvesFracturedBiot) {
  const test::FracturedBiot problem{24};
  const LinearSystem system = problem.build();
  const Vector exact = problem.random_state(4);
  const Vector x = solve(*make(), system, system.local * exact);
  EXPECT_LT(test::block_difference(system, x, exact), 1e-8);
}

// Factoring may not see it, but no solver may call a floating problem solved. The load has a net sum.
TEST_P(EveryLinearSolver, NeverCallsAFloatingProblemSolved) {
  for (const int n : {9, 68}) {
    const LinearSystem floating = test::poisson(n, true);
    const auto solver = make();
    Vector x;
    const bool is_solved = solver->factor(floating).solved && solver->solve(Vector::Ones(n * n), x).solved;
    EXPECT_FALSE(is_solved) << n;
  }
}

INSTANTIATE_TEST_SUITE_P(Types, EveryLinearSolver, testing::Values("umfpack", "mumps", "belos", "auto"),
                         [](const auto& info) { return std::string(info.param); });

// GMRES ends at the tolerance, and not far below it: a step of it gains about a digit. The load is an eigenvector, so
// the error is at most that of the residual by the smallest eigenvalue.
TEST(IterativeSolver, EndsAtItsTolerance) {
  constexpr int n = 40;
  const LinearSystem system = test::poisson(n);
  const double h = std::numbers::pi / (n + 1), smallest = 8 * std::pow(std::sin(h / 2), 2);
  const Vector exact = test::random_vector(n * n, 21), b = system.local * exact;
  for (const double tolerance : {1e-4, 1e-6, 1e-8, 1e-10, 1e-12}) {
    LinearOptions options;
    options.type = "belos";
    options.tolerance = tolerance;
    const Vector x = solve(*make_linear_solver(options), system, b);
    const double residual = (b - system.local * x).norm() / b.norm();
    EXPECT_LE(residual, tolerance);
    EXPECT_GT(residual, 0.005 * tolerance);
    EXPECT_LE((x - exact).norm(), 1.01 * residual * b.norm() / smallest);
  }
}

// A constant that a storage s alone determines, beside exchanges of 1: round-off of A x, some 1e-16, is 1e-16/s of the
// load. It is accepted where it exceeds the tolerance, but not where it leaves less than three digits. As s is the
// smallest eigenvalue, the error is at most the residual, both relative.
TEST(IterativeSolver, AcceptsResidualsThatAreRoundOffAsLongAsThreeDigitsAreLeft) {
  constexpr int n = 20;
  const Vector exact = Vector::Ones(n * n);
  for (const auto& [digits, is_accepted] : {std::pair(20, true), {30, true}, {36, true}, {46, false}, {49, false}}) {
    LinearSystem system = test::poisson(n, true);
    const double storage = std::exp2(-digits);  // exact beside 4
    for (int i = 0; i < n * n; ++i) system.local.coeffRef(i, i) += storage;
    LinearOptions options;
    options.type = "belos";
    const std::unique_ptr<LinearSolver> solver = make_linear_solver(options);
    ASSERT_TRUE(solver->factor(system).solved);
    Vector x;
    const LinearReport report = solver->solve(storage * exact, x);
    EXPECT_EQ(report.solved, is_accepted) << digits << ": " << report.reason;
    EXPECT_GT(report.relative_residual, options.tolerance) << digits;
    EXPECT_LE((x - exact).norm(), 1.01 * report.relative_residual * exact.norm()) << digits;
  }
}

TEST_P(EveryDirectSolver, KeepsTheOrderingOfAPattern) {
  const auto solver = make();
  LinearSystem system = test::poisson(20);
  solve(*solver, system, Vector::Ones(400));
  system.local.coeffRef(5, 5) *= 2;
  solve(*solver, system, Vector::Ones(400));
  EXPECT_EQ(solver->counts().orderings, 1);
  EXPECT_EQ(solver->counts().factorizations, 2);
  system.local.coeffRef(5, 300) = 0.1;
  const Vector exact = test::random_vector(400, 6);
  EXPECT_LT((solve(*solver, system, system.local * exact) - exact).norm(), 1e-10);
  EXPECT_EQ(solver->counts().orderings, 2);
}

// Rounding leaves a floating problem's last pivot at 1e-16 or so, not at zero: a solver that looks for zeros misses it.
TEST_P(EveryDirectSolver, RefusesAFloatingProblem) {
  LinearSystem floating = test::poisson(60, true);
  for (int row = 0; row < 3600; ++row)  // another scale in every row, so that sums round
    for (SparseMatrix::InnerIterator entry(floating.local, row); entry; ++entry) entry.valueRef() *= 1 + 0.37 * row;
  const LinearReport report = make()->factor(floating);
  EXPECT_FALSE(report.solved);
  EXPECT_THAT(report.reason, HasSubstr("singular"));
  EXPECT_THAT(report.reason, HasSubstr("pore.pressure"));
  Vector x;
  EXPECT_FALSE(make()->solve(Vector::Ones(3600), x).solved);
}

// A sum of balances determines the constant mode by entries that are, in other units, far below another entry of its
// row. Nothing is wrong with that; what else moves freely is still found.
TEST_P(EveryDirectSolver, TakesWhatIsSmallInASumForWhatItIs) {
  const int n = 8, cells = n * n;
  for (const bool something_floats : {false, true}) {
    LinearSystem system = test::poisson(n, true);
    const LinearSystem other = test::poisson(12, true);
    std::vector<Triplet> entries;
    for (int row = 1; row < cells; ++row)
      for (SparseMatrix::InnerIterator entry(system.local, row); entry; ++entry)
        entries.emplace_back(row, static_cast<int>(entry.col()), entry.value());
    for (int column = 0; column < cells; ++column) entries.emplace_back(0, column, 1e-19);
    entries.emplace_back(0, cells, 1);
    entries.emplace_back(cells, cells, 1);
    for (int row = 0; row < other.local.rows(); ++row)
      for (SparseMatrix::InnerIterator entry(other.local, row); entry; ++entry)
        entries.emplace_back(cells + 1 + row, cells + 1 + static_cast<int>(entry.col()), entry.value());
    if (!something_floats) entries.emplace_back(cells + 1, cells + 1, 1);
    UnknownBlock rest = other.blocks[0];
    rest.name = "rock.displacement";
    rest.first = cells + 1;
    const int size = cells + 1 + rest.entities;
    system = test::make_system(
        size, entries, {system.blocks[0], {"conduit.aperture", cells, 1, 1, BlockKind::interface, {}, {}}, rest});
    Vector exact = test::random_vector(size, 3);
    exact[cells] = 0;
    Vector x;
    for (const bool is_told : {false, true}) {
      if (is_told) system.sums = {0};
      const auto solver = make();
      const LinearReport factored = solver->factor(system);
      EXPECT_EQ(factored.solved, !something_floats) << factored.reason;
      if (something_floats) {
        EXPECT_THAT(factored.reason, HasSubstr("rock.displacement"));
        continue;
      }
      ASSERT_TRUE(solver->solve(system.local * exact, x).solved);
      EXPECT_LT((x - exact).lpNorm<Eigen::Infinity>(), 1e-10);
    }
  }
}

// Nothing but a row that is scaled by another unknown holds two others, by an entry that is round-off beside that: a
// matter of units, and no step to a singular matrix.
TEST_P(EveryDirectSolver, TakesWhatIsSmallInARowForWhatItIs) {
  for (const double held : {1e-12, 1e-16, 1e-20}) {
    const LinearSystem system =
        test::make_system(4, {{0, 0, 1}, {0, 1, -1}, {1, 0, held}, {1, 2, 1}, {2, 2, 1}, {2, 3, 0.5}, {3, 3, 2}}, {});
    const auto solver = make();
    const LinearReport factored = solver->factor(system);
    ASSERT_TRUE(factored.solved) << held << ": " << factored.reason;
    const Vector exact{{3, 2, 0, 0}};
    Vector x;
    ASSERT_TRUE(solver->solve(system.local * exact, x).solved);
    EXPECT_LT((x - exact).lpNorm<Eigen::Infinity>(), 1e-12) << held;
  }
}

// Two unknowns that differ by d in one of two rows, which stands in scales that are set by a third unknown: to the
// norms of all rows this is round-off, but not to its own row. In other scales the matrix is well away from a singular
// one.
TEST_P(EveryDirectSolver, TellsARowThatIsScaledDownFromRoundOff) {
  for (const double d : {0.0, 4e-12}) {
    const LinearSystem system =
        test::make_system(3, {{0, 0, 1}, {0, 1, -1}, {1, 0, 1e-3}, {1, 1, -1e-3 * (1 - d)}, {1, 2, 1}, {2, 2, 1}}, {});
    const auto solver = make();
    const LinearReport factored = solver->factor(system);
    EXPECT_EQ(factored.solved, d > 0) << factored.reason;
    if (d == 0) continue;
    const Vector exact = test::random_vector(3, 1);
    Vector x;
    ASSERT_TRUE(solver->solve(system.local * exact, x).solved);
    // Round-off of the row, over what determines the difference in it.
    EXPECT_LT((x - exact).lpNorm<Eigen::Infinity>(), std::numeric_limits<double>::epsilon() / (1e-3 * d));
  }
}

// A rock half without support moves freely: its displacement is named, not the pressure's or the other half's.
TEST_P(EveryDirectSolver, NamesTheBlockThatFloats) {
  LinearSystem system = test::poisson(20);
  const LinearSystem floating = test::poisson(12, true);
  std::vector<Triplet> entries;
  for (const auto& [part, first] : {std::pair<const LinearSystem*, int>{&system, 0}, {&floating, 400}})
    for (int row = 0; row < part->local.rows(); ++row)
      for (SparseMatrix::InnerIterator entry(part->local, row); entry; ++entry)
        entries.emplace_back(first + row, first + static_cast<int>(entry.col()), entry.value());
  UnknownBlock loose = floating.blocks.front();
  loose.name = "rock.displacement";
  loose.first = 400;
  const LinearReport report = make()->factor(test::make_system(544, entries, {system.blocks.front(), loose}));
  EXPECT_FALSE(report.solved);
  EXPECT_THAT(report.reason, HasSubstr("rock.displacement"));
}

TEST_P(EveryDirectSolver, AcceptsAnIllConditionedSystem) {
  constexpr int n = 7;  // the Hilbert matrix of this size has condition number 4.8e8
  std::vector<Triplet> entries;
  for (int i = 0; i < n; ++i)
    for (int j = 0; j < n; ++j) entries.emplace_back(i, j, 1.0 / (i + j + 1));
  const LinearSystem system = test::make_system(n, entries, {});
  const Vector exact = Vector::Ones(n);
  const Vector x = solve(*make(), system, system.local * exact);
  EXPECT_LT((x - exact).norm(), 1e-6);  // epsilon times 4.8e8
}

// An open fracture in tight rock: twelve decades between the flow along it and the leak out of it cost twelve digits,
// and leave three; one decade more is rightly refused.
TEST_P(EveryDirectSolver, DoesNotTakeContrastsForSingularity) {
  for (const double fracture_mobility : {1e-9, 1e-7, 1e-5})
    for (const double mobility : {1e-17, 1e-13}) {
      test::FracturedBiot problem{24};
      problem.fracture_mobility = fracture_mobility;
      problem.mobility = mobility;
      const LinearSystem system = problem.build();
      Vector b = Vector::Zero(problem.unknowns());
      b[problem.fracture_pressure(12)] = 1e-5;
      const auto solver = make();
      const LinearReport factored = solver->factor(system);
      EXPECT_TRUE(factored.solved) << fracture_mobility << " " << mobility << ": " << factored.reason;
      Vector x;
      const LinearReport solved = solver->solve(b, x);
      EXPECT_TRUE(solved.solved) << fracture_mobility << " " << mobility << ": " << solved.reason;
    }
}

INSTANTIATE_TEST_SUITE_P(Types, EveryDirectSolver, testing::Values("umfpack", "mumps"),
                         [](const auto& info) { return std::string(info.param); });

/// Systems of one pattern have one ordering, and with it the bits that they have with one of their own.
TEST(KeptOrderings, ServeLaterSolversOfTheSamePattern) {
  const LinearSystem first = test::poisson(12);
  LinearSystem second = first;
  second.local.coeffs() *= 3;
  second.local.coeffRef(5, 5) = 17;
  const auto solution = [&](const LinearSystem& system, int orderings) {
    LinearOptions options;
    options.type = "mumps";
    const auto solver = make_linear_solver(options);
    const Vector x = solve(*solver, system, Vector::Ones(system.local.rows()));
    EXPECT_EQ(solver->counts().orderings, orderings);
    return x;
  };
  const Vector alone = solution(second, 1);
  {
    const KeptOrderings kept;
    solution(first, 1);
    EXPECT_EQ(solution(second, 0), alone);
    solution(test::poisson(11), 1);
  }
  EXPECT_EQ(solution(second, 1), alone);
}

TEST(MakeLinearSolver, RefusesAnUnknownTypeAndListsTheKnown) {
  LinearOptions options;
  options.type = "umpfack";
  EXPECT_THAT([&] { make_linear_solver(options); },
              testing::ThrowsMessage<std::invalid_argument>(
                  "unknown linear solver 'umpfack' (there are: auto, umfpack, mumps, belos)"));
}

TEST(MakeLinearSolver, AutomaticallyTakesUmfpackInOneProcess) {
  const auto solver = make_linear_solver({});
  EXPECT_EQ(solver->name(), "auto");
  ASSERT_TRUE(solver->factor(test::poisson(5)).solved);
  EXPECT_EQ(solver->name(), "umfpack");
}

TEST(Blas, HasANameAndOpenBlasIsNotTheReference) {
  const BlasInfo info = blas_in_use();
  EXPECT_FALSE(info.name.empty());
  EXPECT_NE(info.name, "none");
  EXPECT_FALSE(info.is_reference && info.name.find("OpenBLAS") != std::string::npos);
}

}  // namespace
}  // namespace sprekk
