// Balances that one call declares, against the same amounts added up by hand.
#include "framework/assembly/balance_rows.hpp"

#include <gtest/gtest.h>

#include <stdexcept>

#include "framework/assembly/assembly.hpp"

namespace sprekk {
namespace {

struct TwoBalances : testing::Test {
  static FieldSpec spec(const char* name) {
    return {.owner = "part",
            .name = name,
            .location = Location::cell,
            .role = Role::unknown(BlockKind::interface),
            .unit = "",
            .doc = ""};
  }
  const Field one{spec("one"), 3}, other{spec("other"), 2}, elsewhere{spec("elsewhere"), 3};
  Assembly assembly{{&one, &other}, Assembly::Request::residual};
  const Balances& balances = assembly.balances();

  static Vector vector(double a, double b, double c) { return Eigen::Vector3d(a, b, c); }
};

// stored + outflow − supplied, and in the sum only what leaves all rows.
TEST_F(TwoBalances, CountStoredExchangedAndSupplied) {
  BalanceRows rows(assembly, one, "fluid");
  rows.store(vector(1, -2, 4), 100);
  rows.supply(vector(0, 0.5, 0));
  rows.exchange(vector(7, -5, 3), vector(0, 0, 5), 1000);
  EXPECT_EQ(assembly.residual(0), vector(8, -7.5, 7));
  EXPECT_EQ(balances.residual(0), vector(1, -2.5, 9));
  EXPECT_EQ(balances.throughput(0), vector(1, 2.5, 9));
  EXPECT_EQ(assembly.round_off_base(0), 1000);
  // What cancels in each row is absent from the sum; that of what is stored adds up: 3 rows of 100.
  EXPECT_EQ(balances.round_off_base(0), 300);
  EXPECT_EQ(balances.magnitude(0), 7);
}

TEST_F(TwoBalances, OfOneQuantityAreOne) {
  BalanceRows(assembly, one, "fluid");
  BalanceRows(assembly, other, "fluid");
  ASSERT_EQ(balances.quantities().size(), 1u);
  EXPECT_EQ(balances.quantities()[0].unknowns, (std::vector<int>{0, 1}));
  EXPECT_THROW(BalanceRows(assembly, one, "fluid"), std::logic_error);
}

TEST_F(TwoBalances, CountWhatOthersAdd) {
  assembly.add(one, vector(1, 1, 1));  // before the owner has declared these rows to be balances
  BalanceRows(assembly, one, "fluid");
  BalanceRows(assembly, one).store(vector(0, 3, 0));
  BalanceRows(assembly, one).add_throughput(vector(-2, 0, 0));
  EXPECT_EQ(balances.residual(0), vector(1, 4, 1));
  EXPECT_EQ(balances.throughput(0), vector(2, 3, 0));
}

TEST_F(TwoBalances, AreNoneWithoutTheirOwner) {
  BalanceRows(assembly, one).store(vector(1, 2, 3));
  EXPECT_EQ(assembly.residual(0), vector(1, 2, 3));
  EXPECT_TRUE(balances.quantities().empty());
  EXPECT_FALSE(balances.are_rows_of(0));
}

TEST_F(TwoBalances, OutsideOfTheSolveAreIgnored) {
  BalanceRows rows(assembly, elsewhere, "fluid");
  rows.store(vector(1, 2, 3));
  rows.supply(vector(1, 2, 3));
  rows.exchange(vector(1, 2, 3), vector(0, 0, 6));
  EXPECT_TRUE(balances.quantities().empty());
  EXPECT_EQ(assembly.residual(0), vector(0, 0, 0));
}

}  // namespace
}  // namespace sprekk
