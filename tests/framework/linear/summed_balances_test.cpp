// The constant mode of contents that exchange much more than they store, against its closed form.
#include "framework/linear/reduction/summed_balances.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "tests/framework/linear/test_systems.hpp"

namespace sprekk {
namespace {

using testing::HasSubstr;

class SummedBalancesOf : public testing::TestWithParam<const char*> {
 protected:
  std::unique_ptr<LinearSolver> make() const {
    LinearOptions options;
    options.type = GetParam();
    return make_linear_solver(options);
  }
};

// One content gives, another takes more: the constant is the rest over all that is stored, however well they exchange.
TEST_P(SummedBalancesOf, HoldsTheLevelByStorageAlone) {
  for (const double storage : {1e-9, 1e-14, 1e-18, 1e-25})
    for (const double conductance : {1.0, 1e4}) {
      const test::Exchange problem{30, storage, conductance};
      const auto solver = make();
      const LinearReport factored = solver->factor(problem.build());
      ASSERT_TRUE(factored.solved) << storage << ": " << factored.reason;
      Vector x;
      const LinearReport solved = solver->solve(problem.right_hand_side(), x);
      ASSERT_TRUE(solved.solved) << storage << ": " << solved.reason;
      EXPECT_LT((x - problem.solution()).head(30).lpNorm<Eigen::Infinity>(),
                1e-9 * problem.solution().head(30).lpNorm<Eigen::Infinity>())
          << storage << " " << conductance;
    }
}

TEST_P(SummedBalancesOf, RefusesALevelThatNothingHolds) {
  const LinearReport report = make()->factor(test::Exchange{30, 0, 1e4}.build());
  EXPECT_FALSE(report.solved);
  EXPECT_THAT(report.reason, HasSubstr("singular"));
  EXPECT_THAT(report.reason, HasSubstr("conduit.pressure"));
}

INSTANTIATE_TEST_SUITE_P(Types, SummedBalancesOf, testing::Values("umfpack", "mumps", "auto"),
                         [](const auto& info) { return std::string(info.param); });

// Against what is exchanged in the step: 3e-20 and 3e-5 of it.
TEST(ExchangingRows, AreThoseThatStoreLittle) {
  const LinearSystem weak = test::Exchange{4, 1e-12, 1}.build();
  EXPECT_THAT(exchanging_rows(weak.local, weak.blocks), testing::ElementsAre(testing::ElementsAre(0, 1, 2, 3)));
  const LinearSystem strong = test::Exchange{4, 1e3, 1}.build();
  EXPECT_THAT(exchanging_rows(strong.local, strong.blocks), testing::IsEmpty());
}

// The same matrix is that of fluxes with little resistance, which are no balances. Which fluxes have little resistance
// changes with each iteration.
TEST(ExchangingRows, AreNoneOfWhatIsKnownToBeNoBalance) {
  LinearSystem chain = test::Exchange{6, 1e-12, 1e4}.build();
  for (int flux = 6; flux < 11; ++flux) chain.local.coeffRef(flux, flux) = flux % 2 ? 1e-4 : 1e9;
  EXPECT_GT(exchanging_rows(chain.local, chain.blocks).size(), 0U);
  chain.blocks[1].may_store = false;
  for (const std::vector<int>& group : exchanging_rows(chain.local, chain.blocks)) EXPECT_LT(group.back(), 6);
}

// The pattern of what is solved follows no values: derivatives that happen to be zero are entries.
TEST_P(SummedBalancesOf, OrdersOnce) {
  LinearSystem chain = test::Exchange{30, 1e-14, 1}.build();
  chain.blocks[1].may_store = false;
  std::vector<Triplet> entries;
  const int aperture = static_cast<int>(chain.local.cols());
  for (int row = 0; row < aperture; ++row)
    for (SparseMatrix::InnerIterator entry(chain.local, row); entry; ++entry)
      entries.emplace_back(row, static_cast<int>(entry.col()), entry.value());
  for (int i = 0; i < 30; ++i) entries.insert(entries.end(), {{i, aperture + i, 1}, {aperture + i, aperture + i, 1}});
  std::vector<UnknownBlock> blocks = chain.blocks;
  blocks.push_back({"conduit.aperture", aperture, 30, 1, BlockKind::interface, {}, {}});
  blocks.back().may_store = false;
  LinearSystem system = test::make_system(aperture + 30, entries, blocks);
  const auto solver = make();
  for (int iteration = 0; iteration < 4; ++iteration) {
    for (int i = 0; i < 30; ++i) system.local.coeffRef(i, aperture + i) = (i + iteration) % 3 - 1.0;
    ASSERT_TRUE(solver->factor(system).solved);
  }
  EXPECT_EQ(solver->counts().factorizations, 4);
  EXPECT_EQ(solver->counts().orderings, 1);
}

// Two chains, of which one stores little in all systems and the other in some: the pattern is that of both sums. The
// same system has the same bits whatever has been solved before, as a run that is continued needs.
TEST_P(SummedBalancesOf, OrdersOnceWhereASumComesAndGoes) {
  const auto chains = [](double storage) {
    const LinearSystem one = test::Exchange{30, 1e-14, 1}.build(), other = test::Exchange{30, storage, 1}.build();
    const int size = static_cast<int>(one.local.cols());
    // Contents of both, then exchanges of both: the balances are one block.
    const auto place = [](int chain, int unknown) {
      return unknown < 30 ? 30 * chain + unknown : 30 + unknown + 29 * chain;
    };
    std::vector<Triplet> entries;
    for (const auto& [chain, system] : {std::pair<int, const LinearSystem*>{0, &one}, {1, &other}})
      for (int row = 0; row < size; ++row)
        for (SparseMatrix::InnerIterator entry(system->local, row); entry; ++entry)
          entries.emplace_back(place(chain, row), place(chain, static_cast<int>(entry.col())), entry.value());
    std::vector<UnknownBlock> blocks = one.blocks;
    blocks[0].entities = 60;
    blocks[1].first = 60;
    blocks[1].entities = 58;
    blocks[1].may_store = false;
    return test::make_system(2 * size, entries, blocks);
  };
  EXPECT_THAT(possible_sums(chains(1).local, chains(1).blocks), testing::SizeIs(2));
  const Vector exact = test::random_vector(118, 5);
  const auto solver = make();
  for (const double storage : {1e-14, 1e3, 1e-14, 1e2}) {
    const LinearSystem system = chains(storage);
    EXPECT_THAT(exchanging_rows(system.local, system.blocks), testing::SizeIs(storage < 1 ? 2 : 1));
    Vector x, alone;
    const auto other = make();
    ASSERT_TRUE(solver->factor(system).solved);
    ASSERT_TRUE(solver->solve(system.local * exact, x).solved);
    ASSERT_TRUE(other->factor(system).solved);
    ASSERT_TRUE(other->solve(system.local * exact, alone).solved);
    EXPECT_EQ(x, alone) << storage;
    EXPECT_LT(((system.local * (x - exact)).cwiseAbs().array() / (system.local.cwiseAbs() * exact.cwiseAbs()).array())
                  .maxCoeff(),
              1e-9)
        << storage;
  }
  EXPECT_EQ(solver->counts().orderings, 1);
  EXPECT_EQ(solver->counts().factorizations, 4);
}

// The last flux leaves what the chain has: the constant is determined from outside.
TEST(ExchangingRows, DoNotLeadOut) {
  LinearSystem open = test::Exchange{4, 1e-12, 1}.build();
  open.local.coeffRef(3, 3) = 1;
  for (const int column : {4, 5, 6}) open.local.coeffRef(3, column) = 0;
  EXPECT_THAT(exchanging_rows(open.local, open.blocks), testing::IsEmpty());
}

/// A chain with a well in its second content: the rate q of the well, with R q = p_w - p, and its pressure p_w, for
/// which the rate or the pressure is given.
LinearSystem with_well(double resistance, bool is_rate_given) {
  const LinearSystem chain = test::Exchange{30, 1e-14, 1e4}.build();
  std::vector<Triplet> entries;
  for (int row = 0; row < chain.local.rows(); ++row)
    for (SparseMatrix::InnerIterator entry(chain.local, row); entry; ++entry)
      entries.emplace_back(row, static_cast<int>(entry.col()), entry.value());
  const int rate = static_cast<int>(chain.local.cols()), pressure = rate + 1;
  entries.insert(entries.end(), {{1, rate, -3e7}, {rate, rate, resistance}, {rate, pressure, -1}, {rate, 1, 1}});
  entries.emplace_back(pressure, is_rate_given ? rate : pressure, 1);
  std::vector<UnknownBlock> blocks = chain.blocks;
  for (std::size_t k = 0; k < 2; ++k) {
    blocks.push_back(
        {k == 0 ? "wells.rate" : "wells.pressure", rate + static_cast<int>(k), 1, 1, BlockKind::interface, {}, {}});
    blocks.back().may_store = false;
  }
  return test::make_system(pressure + 1, entries, blocks);
}

// A well whose rate is given follows the pressure of its cell, and does not hold it, whatever its resistance.
TEST_P(SummedBalancesOf, HoldsTheLevelBesideAWellOfGivenRate) {
  for (const double resistance : {0.0, 1e-12, 1.0}) {
    const LinearSystem system = with_well(resistance, true);
    EXPECT_THAT(exchanging_rows(system.local, system.blocks), testing::SizeIs(1)) << resistance;
    const auto solver = make();
    const LinearReport factored = solver->factor(system);
    ASSERT_TRUE(factored.solved) << factored.reason;
    Vector b = Vector::Zero(system.local.cols()), x;
    b[b.size() - 1] = 1e-16;  // the rate
    ASSERT_TRUE(solver->solve(b, x).solved);
    const double level = 3e7 * 1e-16 / (30 * 1e-14);  // what it brings, over all that is stored
    EXPECT_NEAR(x.head(30).minCoeff(), level, 1e-9 * level) << resistance;
    EXPECT_NEAR(x.head(30).maxCoeff(), level, 1e-9 * level) << resistance;
    EXPECT_NEAR(x[x.size() - 1], level + resistance * 1e-16, 1e-9 * level) << resistance;
  }
}

TEST(ExchangingRows, DoNotLeadToAWellOfGivenPressure) {
  const LinearSystem system = with_well(0, false);
  EXPECT_THAT(exchanging_rows(system.local, system.blocks), testing::IsEmpty());
}

// Where three cells meet, two fluxes depend on stored amounts, and the third one on these two fluxes.
TEST(ExchangingRows, AreJoinedByWhatAnswersToContents) {
  LinearSystem three = test::Exchange{3, 1e-12, 1}.build();
  std::vector<Triplet> entries = {{1, 5, -3e7}, {2, 5, 3e7}, {5, 5, 1}, {5, 3, 0.5}, {5, 4, 0.5}};
  for (int row = 0; row < three.local.rows(); ++row)
    for (SparseMatrix::InnerIterator entry(three.local, row); entry; ++entry)
      entries.emplace_back(row, static_cast<int>(entry.col()), entry.value());
  three.local = SparseMatrix(6, 6);
  three.local.setFromTriplets(entries.begin(), entries.end());
  three.blocks[1].entities = 3;
  EXPECT_THAT(exchanging_rows(three.local, three.blocks), testing::ElementsAre(testing::ElementsAre(0, 1, 2)));
}

}  // namespace
}  // namespace sprekk
