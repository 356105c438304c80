// Several processes factorize the bulk once together, and give the answer of one.
#include <gtest/gtest.h>

#include <Eigen/LU>
#include <numeric>

#include "framework/linear/reduction/bulk_schur_complement.hpp"
#include "framework/linear/reduction/condensed_solver.hpp"
#include "framework/linear/reduction/floating_parts.hpp"
#include "framework/parallel/alone.hpp"
#include "framework/parallel/parallel.hpp"
#include "framework/parallel/row_exchange.hpp"
#include "tests/framework/linear/test_systems.hpp"

namespace sprekk {
namespace {

LinearSystem mine(const LinearSystem& whole) { return test::strip(whole, parallel::rank(), parallel::size()); }

LinearOptions options(bool bulk_changes_often) {
  LinearOptions options;
  options.bulk_changes_often = bulk_changes_often;
  return options;
}

const test::FracturedBiot biot{16};

class CondensedTogether : public testing::TestWithParam<bool> {
 protected:
  CondensedSolver solver{options(GetParam())};

  /// The largest difference of a block from the known solution.
  double error(const LinearSystem& whole, unsigned seed) {
    const LinearSystem system = mine(whole);
    const LinearReport factored = solver.factor(system);
    EXPECT_TRUE(factored.solved) << factored.reason;
    const Vector exact = biot.random_state(seed);
    Vector x;
    const LinearReport solved = solver.solve(test::rows_of(system, whole.local * exact), x);
    EXPECT_TRUE(solved.solved) << solved.reason;
    return test::block_difference(whole, x, exact);
  }
};

TEST_P(CondensedTogether, FactorizesTheBulkOnceForRowsOnFracturesThatChange) {
  LinearSystem whole = biot.build();
  EXPECT_LT(error(whole, 4), 1e-8);
  EXPECT_EQ(solver.name(), "condensed mumps");
  constexpr int others = 3;
  for (int other = 0; other < others; ++other) {
    // The conductance of one wall, whose row is one process's, and then friction of all.
    whole.local.coeffRef(biot.wall_flux(2, 0), biot.wall_flux(2, 0)) *= 2;
    if (other > 0)
      for (int row = biot.traction(0, 0); row < biot.unknowns(); ++row) whole.local.row(row) *= 1.0 + row % 3;
    EXPECT_LT(error(whole, 5 + other), 1e-8) << other;
  }
  EXPECT_EQ(solver.counts().condensed, 1 + others);
  // With a border, a change of its rows that is no scaling by a power of two is a new factorization.
  EXPECT_EQ(solver.counts().factorizations, GetParam() ? 1 + others - 1 : 1);
}

TEST_P(CondensedTogether, FactorizesAgainWhereTheBulkOfOneProcessChanges) {
  LinearSystem whole = biot.build();
  EXPECT_LT(error(whole, 4), 1e-8);
  whole.local.coeffRef(0, 0) *= 1.5;
  EXPECT_LT(error(whole, 5), 1e-8);
  EXPECT_EQ(solver.counts().factorizations, 2);
}

TEST_P(CondensedTogether, SolvesTheWholeWhereTheBulkIsSingular) {
  LinearSystem whole = biot.build();
  for (int row = 0; row < whole.local.rows(); ++row)
    for (SparseMatrix::InnerIterator entry(whole.local, row); entry; ++entry)
      if (entry.row() == 0) entry.valueRef() = entry.col() == biot.wall_flux(0, 0) ? 1 : 0;
  const LinearSystem system = mine(whole);
  const LinearReport factored = solver.factor(system);
  EXPECT_NE(solver.name(), "condensed mumps") << factored.reason;
}

INSTANTIATE_TEST_SUITE_P(Bulks, CondensedTogether, testing::Values(false, true),
                         [](const auto& info) { return info.param ? "that_change_often" : "that_stay"; });

TEST(SchurComplementOfAll, IsThatOfADenseElimination) {
  const LinearSystem whole = biot.build(), system = mine(whole);
  Eigen::MatrixXd exact;
  BulkSplitting split(system);
  split.update(system.local);
  {
    const parallel::Alone by_myself;
    BulkSplitting dense(whole);
    dense.update(whole.local);
    exact = dense.fb.matrix * Eigen::MatrixXd(dense.bb()).partialPivLu().solve(Eigen::MatrixXd(dense.bf.matrix));
  }
  for (const bool is_short_lived : {false, true}) {
    const auto solver = make_linear_solver(options(false));
    BulkSchurComplement schur;
    ASSERT_TRUE(schur.compute(split, *solver, is_short_lived).solved);
    const Eigen::MatrixXd rows = *schur.schur_rows(split, *solver);
    const Eigen::MatrixXd expected = exact(split.interface_rows, split.interface_columns);
    ASSERT_EQ(rows.rows(), expected.rows());
    for (int k = 0; k < rows.rows(); ++k)
      EXPECT_LT((rows.row(k) - expected.row(k)).norm(), 1e-9 * expected.row(k).norm()) << is_short_lived << k;
  }
}

// Bytes of the bulk: those of one process, shared. What each has of fractures is the same everywhere.
TEST(BulkOfAll, IsHeldOnce) {
  const auto bytes_of = [](const SparseMatrix& a) {
    return static_cast<double>(a.nonZeros() * (sizeof(double) + sizeof(int)) + a.outerSize() * sizeof(int));
  };
  const LinearSystem whole = test::FracturedBiot{40}.build();
  const BulkSplitting split(mine(whole));
  double bulk = 0, fractures = 0;
  {
    const parallel::Alone by_myself;
    const BulkSplitting alone(whole);
    bulk = bytes_of(alone.bb()) + bytes_of(alone.bf.matrix);
    fractures = bytes_of(alone.fb.matrix) + bytes_of(alone.ff.matrix);
  }
  const double here = bytes_of(split.bb()) + bytes_of(split.bf.matrix);
  EXPECT_EQ(parallel::sum(here), bulk);
  EXPECT_LE(parallel::max(here), 1.3 * bulk / parallel::size());  // strips of unlike numbers of nodes
  EXPECT_EQ(bytes_of(split.fb.matrix) + bytes_of(split.ff.matrix), fractures);
}

// A pressure that nothing in its own rows holds: its parts are known, and chosen, alike on all processes.
TEST(PartsHeldByFractures, AreThoseOfOneProcess) {
  constexpr int n = 12, half = n * n / 2;
  LinearSystem whole = test::poisson(n, true);
  // Two floating halves: what joins row half - n + i to half + i is taken out.
  for (int i = 0; i < n; ++i) {
    const int low = half - n + i, high = half + i;
    whole.local.coeffRef(low, high) = whole.local.coeffRef(high, low) = 0;
    whole.local.coeffRef(low, low) -= 1;
    whole.local.coeffRef(high, high) -= 1;
  }
  std::vector<char> expected;
  {
    const parallel::Alone by_myself;
    expected = unknowns_held_by_fractures(whole);
  }
  EXPECT_EQ(std::accumulate(expected.begin(), expected.end(), 0), 2);
  EXPECT_EQ(unknowns_held_by_fractures(mine(whole)), expected);
}

TEST(RowExchange, BringsRowsToThoseThatWantThem) {
  const int rank = parallel::rank(), size = parallel::size(), rows = 7 * size;
  std::vector<int> have, want;
  for (int row = rows - 1; row >= 0; --row)
    if (row % size == rank) have.push_back(row);
  for (int row = rank; row < rows; row += 1 + rank) want.push_back(row);  // those of others, too, and some twice
  Eigen::MatrixXd values(have.size(), 2);
  for (std::size_t i = 0; i < have.size(); ++i) values.row(i) << have[i], -0.5 * have[i];
  const Eigen::MatrixXd moved = parallel::RowExchange(have, want).moved(values);
  ASSERT_EQ(moved.rows(), static_cast<Eigen::Index>(want.size()));
  for (std::size_t i = 0; i < want.size(); ++i) {
    EXPECT_EQ(moved(i, 0), want[i]);
    EXPECT_EQ(moved(i, 1), -0.5 * want[i]);
  }
}

TEST(Alone, IsTheOnlyProcess) {
  {
    const parallel::Alone by_myself;
    EXPECT_EQ(parallel::size(), 1);
    EXPECT_EQ(parallel::sum(3), 3);
  }
  EXPECT_GT(parallel::size(), 1);
}

}  // namespace
}  // namespace sprekk
