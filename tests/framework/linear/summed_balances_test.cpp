// The level of contents that exchange much more than they store, against its closed form.
#include "framework/linear/summed_balances.hpp"

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

// One content gives, another takes more: the level is the rest over all that is stored, however well they exchange.
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

// The last flux leaves what the chain has: the level is given from outside.
TEST(ExchangingRows, DoNotLeadOut) {
  LinearSystem open = test::Exchange{4, 1e-12, 1}.build();
  open.local.coeffRef(3, 3) = 1;
  for (const int column : {4, 5, 6}) open.local.coeffRef(3, column) = 0;
  EXPECT_THAT(exchanging_rows(open.local, open.blocks), testing::IsEmpty());
}

// Where three meet, two exchanges answer to contents and the third one to the others.
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
