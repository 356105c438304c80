// Blocks of a bulk that nothing in its own equations holds, of springs whose rigid motions are exact.
#include "framework/linear/reduction/floating_parts.hpp"

#include <gtest/gtest.h>

#include <Eigen/SVD>
#include <algorithm>
#include <cmath>

#include "tests/framework/linear/test_systems.hpp"

namespace sprekk {
namespace {

enum class Held { nowhere, on_rollers, everywhere };

/// Blocks of n × n points, each joined to its neighbours, also over diagonals, by springs; turned by an angle (rad).
/// A pressure at the same points, which a spring of its own holds, and a local unknown that reads the first point.
class Springs {
 public:
  Springs(std::vector<Held> blocks, int n, double angle, double bend = 0) : n_(n), cos_(std::cos(angle)) {
    const double sin = std::sin(angle);
    const int points = static_cast<int>(blocks.size()) * n * n;
    for (std::size_t b = 0; b < blocks.size(); ++b)
      for (int j = 0; j < n; ++j)
        for (int i = 0; i < n; ++i) {
          const double x = i + 3.0 * n * b, y = j + bend * i * i;
          places_.emplace_back(cos_ * x - sin * y, sin * x + cos_ * y);
        }
    for (std::size_t b = 0; b < blocks.size(); ++b) {
      for (int j = 0; j < n; ++j)
        for (int i = 0; i < n; ++i)
          for (const auto& [di, dj] : {std::array{1, 0}, {0, 1}, {1, 1}, {-1, 1}})
            if (i + di >= 0 && i + di < n && j + dj < n) spring(point(b, i, j), point(b, i + di, j + dj));
      for (int i = 0; i < n && blocks[b] != Held::nowhere; ++i)  // rollers along the turned x-axis
        for (int c = 0; c < 2; ++c)
          for (int d = 0; d < 2; ++d) {
            const double normal[2] = {-sin, cos_};
            add(2 * point(b, i, 0) + c, 2 * point(b, i, 0) + d, normal[c] * normal[d]);
            if (blocks[b] == Held::everywhere)
              add(2 * point(b, i, 0) + c, 2 * point(b, i, 0) + d, (c == d) - normal[c] * normal[d]);
          }
    }
    const int local = 3 * points;
    for (int p = 0; p < points; ++p) add(2 * points + p, 2 * points + p, 1);
    add(local, local, 1);
    add(local, 0, 1);
    add(0, local, 1);
    system = test::make_system(
        local + 1, entries_,
        {{"rock.displacement", 0, points, 2, BlockKind::bulk_elastic, test::columns_of(places_), {}},
         {"pore.pressure", 2 * points, points, 1, BlockKind::bulk_elliptic, test::columns_of(places_), {}},
         {"contact.traction", local, 1, 1, BlockKind::interface, {}, {}}});
  }

  LinearSystem system;

 private:
  int point(std::size_t block, int i, int j) const { return (static_cast<int>(block) * n_ + j) * n_ + i; }
  void add(int row, int column, double value) { entries_.emplace_back(row, column, value); }
  void spring(int a, int b) {
    const Point along = (places_[b] - places_[a]).normalized();
    for (int c = 0; c < 2; ++c)
      for (int d = 0; d < 2; ++d) {
        const double k = along[c] * along[d];
        add(2 * a + c, 2 * a + d, k);
        add(2 * b + c, 2 * b + d, k);
        add(2 * a + c, 2 * b + d, -k);
        add(2 * b + c, 2 * a + d, -k);
      }
  }

  int n_;
  double cos_;
  std::vector<Point> places_;
  std::vector<Triplet> entries_;
};

int count(const std::vector<char>& held) { return static_cast<int>(std::count(held.begin(), held.end(), 1)); }

/// The ratio of the largest and the smallest singular value of what is left of the bulk.
double condition_of_the_rest(const LinearSystem& system, const std::vector<char>& held) {
  std::vector<int> rest;
  for (const UnknownBlock& block : system.blocks)
    for (int i = 0; i < block.entities * block.components; ++i)
      if (block.kind != BlockKind::interface && !held[block.first + i]) rest.push_back(block.first + i);
  const Eigen::MatrixXd whole = system.local;
  const Eigen::BDCSVD<Eigen::MatrixXd> svd(whole(rest, rest));
  return svd.singularValues()[0] / svd.singularValues()[rest.size() - 1];
}

class FloatingParts : public testing::TestWithParam<double> {};
INSTANTIATE_TEST_SUITE_P(Angles, FloatingParts, testing::Values(0.0, 0.4, 1.3, M_PI / 2));

TEST_P(FloatingParts, LoseTwoCellsEach) {
  for (const double bend : {0.0, 1e-9, 0.03}) {
    const Springs three({Held::nowhere, Held::everywhere, Held::nowhere}, 5, GetParam(), bend);
    const std::vector<char> held = unknowns_held_by_fractures(three.system);
    EXPECT_EQ(count(held), 2 * 2 * 3);  // blocks, cells, unknowns of a cell
    EXPECT_LT(condition_of_the_rest(three.system, held), 3e3);
    for (int i = 50; i < 100; ++i) EXPECT_FALSE(held[i]) << "of the block that is held";
  }
}

// Along rollers a block moves, and turns nowhere.
TEST_P(FloatingParts, LoseOneCellWhereTheySlide) {
  const Springs sliding({Held::on_rollers}, 5, GetParam());
  const std::vector<char> held = unknowns_held_by_fractures(sliding.system);
  EXPECT_EQ(count(held), 3);
  EXPECT_LT(condition_of_the_rest(sliding.system, held), 3e3);
}

TEST_P(FloatingParts, AreOneCellOrTwo) {
  EXPECT_EQ(count(unknowns_held_by_fractures(Springs({Held::nowhere}, 1, GetParam()).system)), 3);
  EXPECT_EQ(count(unknowns_held_by_fractures(Springs({Held::nowhere}, 2, GetParam()).system)), 6);
}

TEST_P(FloatingParts, AreNoneWhereTheBulkIsHeld) {
  EXPECT_EQ(count(unknowns_held_by_fractures(Springs({Held::everywhere}, 5, GetParam()).system)), 0);
  EXPECT_EQ(count(unknowns_held_by_fractures(test::FracturedBiot{8}.build())), 0);
}

// A constant mode: no storage and no boundary value, or little of either.
TEST(FloatingLevels, LoseOneCell) {
  for (const double storage : {0.0, 1e-13, 1e-5}) {
    LinearSystem closed = test::poisson(9, true);
    for (int i = 0; i < 81; ++i) closed.local.coeffRef(i, i) += storage;
    closed.blocks.push_back({"conduit.pressure", 81, 0, 1, BlockKind::interface, {}, {}});
    const std::vector<char> held = unknowns_held_by_fractures(closed);
    EXPECT_EQ(count(held), storage < 1e-6 ? 1 : 0) << storage;
    EXPECT_LT(condition_of_the_rest(closed, held), 1e7);
  }
}

// The row of a sum replaces the balance of one cell: this is the cell that is fixed.
TEST(FloatingLevels, AreFixedWhereASumStands) {
  LinearSystem closed = test::poisson(9, true);
  closed.sums = {17};
  for (SparseMatrix::InnerIterator entry(closed.local, 17); entry; ++entry) entry.valueRef() = 0;
  const std::vector<char> held = unknowns_held_by_fractures(closed);
  EXPECT_EQ(count(held), 1);
  EXPECT_TRUE(held[17]);
}

}  // namespace
}  // namespace sprekk
