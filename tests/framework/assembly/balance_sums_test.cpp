// Balances that exchange far more than they hold: what their sum is, and when it takes the place of one of them.
#include "framework/assembly/balance_sums.hpp"

#include <gtest/gtest.h>

#include "framework/assembly/balance_rows.hpp"
#include "framework/assembly/block_system.hpp"
#include "tests/framework/assembly/small_mesh.hpp"

namespace sprekk {
namespace {

/// A ring of cells that exchange with three neighbours before and behind; the first leaves something outside.
/// Conductances of no simple ratio, so that columns cancel to round-off only.
struct Ring : testing::Test {
  const Mesh mesh = test::small_mesh(0.2);
  const int n = mesh.cell_count();
  Field content{{.owner = "a",
                 .name = "content",
                 .location = Location::cell,
                 .role = Role::unknown(BlockKind::interface),
                 .unit = "",
                 .doc = ""},
                n};
  Field bulk{{.owner = "a",
              .name = "bulk",
              .location = Location::cell,
              .role = Role::unknown(BlockKind::bulk_elliptic),
              .unit = "",
              .doc = ""},
             n};
  double capacity = 1e-14, outwards = 0;
  bool is_fixed = false, is_coupled = false;
  Operator exchange = ring(0);

  Operator ring(double leaves) const {
    std::vector<Triplet> entries;
    for (int i = 0; i < n; ++i)
      for (int step = 1; step <= 3; ++step) {
        const double conductance = 1 / (3.0 + i + 0.7 * step);
        const int j = (i + step) % n;
        for (const auto& [row, sign] : {std::pair(i, 1.0), std::pair(j, -1.0)}) {
          entries.emplace_back(row, i, sign * conductance);
          entries.emplace_back(row, j, -sign * conductance);
        }
      }
    const Triplet out(0, 0, leaves);
    entries.push_back(out);
    SparseMatrix all(n, n), leaving(n, n);
    all.setFromTriplets(entries.begin(), entries.end());
    leaving.setFromTriplets(&out, &out + 1);
    return Operator(std::move(all), std::move(leaving));
  }

  std::unique_ptr<Assembly> assemble() {
    auto assembly = std::make_unique<Assembly>(std::vector<const Field*>{&bulk, &content},
                                               Assembly::Request::residual_and_derivatives);
    BalanceRows(*assembly, content, "it");
    assembly->add(content, capacity * content.now() - source());
    assembly->diagonal(content, content, Vector::Constant(n, capacity));
    assembly->linear(content, exchange, content, 2);
    assembly->add(bulk, bulk.now());
    assembly->diagonal(bulk, bulk, Vector::Ones(n));
    if (is_coupled) assembly->diagonal(content, bulk, Vector::Constant(n, 1e-3));
    if (is_fixed) assembly->fix(content, 3, 1, 1);
    return assembly;
  }
  /// A source in one cell, and a sink in another that takes all but a small rest of it.
  Vector source() const {
    Vector source = Vector::Zero(n);
    source[1] = 1;
    source[n / 2] = -1 + rest;
    return source;
  }
  static constexpr double rest = 0x1p-20;
  const std::vector<std::vector<char>> owned{std::vector<char>(n, 1), std::vector<char>(n, 1)};
};

TEST_F(Ring, HasColumnsThatCancelToRoundOffOnly) {
  const Vector sums = Eigen::MatrixXd(exchange.entries()).colwise().sum();
  EXPECT_GT(sums.lpNorm<Eigen::Infinity>(), 0);
  EXPECT_LT(sums.lpNorm<Eigen::Infinity>(), 1e-14);
}

TEST_F(Ring, AddsUpWithoutWhatIsExchanged) {
  content.set(Vector::LinSpaced(n, 1e6, 2e6));
  exchange = ring(3);
  const auto assembly = assemble();
  const SumRow sum = sum_of_rows(*assembly, assembly->balances().quantities()[0], owned, {0, n});
  ASSERT_EQ(static_cast<int>(sum.columns.size()), n);
  EXPECT_EQ(row_to_replace(*assembly, assembly->balances().quantities()[0], owned, {0, n}), n);
  for (int i = 0; i < n; ++i) {
    EXPECT_EQ(sum.columns[i], n + i);
    EXPECT_EQ(sum.values[i], capacity + (i == 0 ? 2 * 3 : 0));
  }
  const double expected = capacity * 1.5e6 * n + 2 * 3 * 1e6 - rest;
  EXPECT_NEAR(sum_of_residuals(*assembly, 1, owned[1]), expected, 1e-15 * expected);
}

TEST_F(Ring, IsWeakWhereOnlyLittleHoldsTheLevel) {
  const auto is_weak_now = [&] {
    const auto assembly = assemble();
    return is_weak(*assembly, assembly->balances().quantities()[0]);
  };
  EXPECT_TRUE(is_weak_now());
  capacity = 1e-5;
  EXPECT_FALSE(is_weak_now());
  capacity = 1e-14;
  exchange = ring(0.1);
  EXPECT_FALSE(is_weak_now());
  exchange = ring(0);
  is_fixed = true;
  EXPECT_FALSE(is_weak_now());
  is_fixed = false;
  is_coupled = true;
  EXPECT_FALSE(is_weak_now());
  const auto answered = assemble();
  EXPECT_TRUE(is_weak(*answered, answered->balances().quantities()[0], true));
  exchange = ring(0.1);
  const auto held = assemble();
  EXPECT_FALSE(is_weak(*held, held->balances().quantities()[0], true));
}

TEST_F(Ring, KeepsItsLevelInASystemWithSums) {
  for (const double c : {1e-10, 1e-16, 1e-30}) {
    capacity = c;
    BlockSystem system(mesh, {&bulk, &content});
    const auto assembly = assemble();
    system.matrix(*assembly);
    EXPECT_TRUE(system.sums().replaced().empty());
    system = BlockSystem(mesh, {&bulk, &content});
    system.use_sums(true);
    LinearOptions options;
    options.type = "umfpack";
    const auto solver = make_linear_solver(options);
    const LinearReport factored = solver->factor(system.matrix(*assembly));
    ASSERT_TRUE(factored.solved) << factored.reason;
    ASSERT_EQ(system.sums().replaced().size(), 1u);
    Vector right = -system.residual(*assembly), update;
    right[system.sums().replaced()[0].place] = -system.residual_of_sum(*assembly, 1);
    ASSERT_TRUE(solver->solve(right, update).solved);
    const Vector values = update.tail(n);
    EXPECT_NEAR(values.mean(), rest / (c * n), 1e-12 * rest / (c * n)) << c;
  }
}

TEST_F(Ring, HasNoSumWhereNothingHoldsTheLevel) {
  capacity = 0;
  BlockSystem system(mesh, {&bulk, &content});
  system.use_sums(true);
  system.matrix(*assemble());
  EXPECT_TRUE(system.sums().replaced().empty());
}

}  // namespace
}  // namespace sprekk
