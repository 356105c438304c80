// Which potentials float: rings of cells with and without something that holds their constant.
#include "framework/assembly/floating_balances.hpp"

#include <gtest/gtest.h>

#include "framework/assembly/balance_rows.hpp"
#include "tests/framework/assembly/small_mesh.hpp"

namespace sprekk {
namespace {

/// Two rings of cells that exchange something with the next cell; `through` lets something pass from one to the other,
/// by a flux with an equation of its own, as through the wall between them.
struct TwoRings : testing::Test {
  const Mesh mesh = test::small_mesh(0.2);
  const int n = mesh.cell_count(), half = n / 2;
  Field potential = field("potential", "Pa"), flux = field("flux", "m/s"), well = field("well", "Pa");
  Vector capacity = Vector::Zero(n);
  double outwards = 0, through = 0, of_well = 0;
  int fixed = -1;

  Field field(const char* name, const char* unit) const {
    return {{.owner = "a",
             .name = name,
             .location = Location::cell,
             .role = Role::unknown(BlockKind::interface),
             .unit = unit,
             .doc = ""},
            n};
  }

  std::vector<FloatingBalances> find() {
    std::vector<Triplet> entries;
    for (int i = 0; i < n; ++i) {
      const int j = i < half ? (i + 1) % half : half + (i + 1 - half) % (n - half);
      const double conductance = 1 / (3.0 + i);
      for (const auto& [row, sign] : {std::pair(i, 1.0), std::pair(j, -1.0)}) {
        entries.emplace_back(row, i, sign * conductance);
        entries.emplace_back(row, j, -sign * conductance);
      }
    }
    SparseMatrix all(n, n), leaving(n, n), differences(n, n), amounts(n, n), rates(n, n);
    const Triplet out(0, 0, outwards);
    entries.push_back(out);
    all.setFromTriplets(entries.begin(), entries.end());
    leaving.setFromTriplets(&out, &out + 1);
    const Operator exchange(std::move(all), std::move(leaving));
    // Flux 0 leads from the first to the second ring, where a well is open to its cell 0.
    for (const auto& [column, sign] : {std::pair(0, 1.0), std::pair(half, -1.0)}) {
      differences.insert(0, column) = -sign * through;
      amounts.insert(column, 0) = sign;
    }
    rates.insert(0, half) = -of_well;
    Assembly assembly({&potential, &flux, &well}, Assembly::Request::residual_and_derivatives);
    BalanceRows(assembly, potential, "it");
    assembly.diagonal(potential, potential, capacity);
    assembly.linear(potential, exchange, potential, 2);
    assembly.derivative(potential, flux, std::move(amounts));
    assembly.diagonal(flux, flux, Vector::Ones(n));
    assembly.derivative(flux, potential, std::move(differences));
    Vector diagonal = Vector::Ones(n);
    if (of_well > 0) diagonal[0] = of_well;
    assembly.diagonal(well, well, diagonal);
    assembly.derivative(well, potential, std::move(rates));
    if (fixed >= 0) assembly.fix(potential, fixed, 1, 1);
    return floating_balances(assembly, std::vector(3, std::vector<char>(n, 1)), {0, n, 2 * n});
  }
  int count() { return static_cast<int>(find().size()); }
};

TEST_F(TwoRings, FloatEachByItself) {
  const std::vector<FloatingBalances> found = find();
  ASSERT_EQ(found.size(), 2u);
  EXPECT_EQ(found[0].first, 0);
  EXPECT_EQ(found[0].balances, half);
  EXPECT_EQ(found[1].first, half);
  EXPECT_EQ(found[1].balances, n - half);
}

TEST_F(TwoRings, AreHeldByWhatIsStoredHoweverLittle) {
  capacity[3] = 1e-30;
  ASSERT_EQ(count(), 1);
  EXPECT_EQ(find()[0].first, half);
  capacity[n - 1] = 1e-30;
  EXPECT_EQ(count(), 0);
}

TEST_F(TwoRings, AreHeldByWhatLeadsOut) {
  outwards = 0.1;
  ASSERT_EQ(count(), 1);
  EXPECT_EQ(find()[0].first, half);
}

TEST_F(TwoRings, AreHeldByAFixedValue) {
  fixed = n - 2;
  ASSERT_EQ(count(), 1);
  EXPECT_EQ(find()[0].first, 0);
}

TEST_F(TwoRings, AreOneWhereAFluxJoinsThem) {
  through = 1e-20;
  ASSERT_EQ(count(), 1);
  EXPECT_EQ(find()[0].balances, n);
  outwards = 1;
  EXPECT_EQ(count(), 0);
}

/// The pressure in a well of given rate follows the one around it: it moves with the constant, and does not hold it.
TEST_F(TwoRings, AreNotHeldByAPotentialThatFollows) {
  of_well = 3;
  EXPECT_EQ(count(), 2);
}

}  // namespace
}  // namespace sprekk
