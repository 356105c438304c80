#include "components/fine_fracture/quarter_point/elasticity/block_cholesky.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include <Eigen/Cholesky>
#include <random>
#include <stdexcept>

namespace sprekk::fine_fracture {
namespace {

/// The stiffness of springs in a plane: between each block and some of those before it, and to the ground. As a tree,
/// each but the last has a spring to one later block, and two blocks share that one: so does the elimination tree.
struct Springs {
  Eigen::MatrixXd dense;
  BlockMatrix blocks;

  Springs(int count, double to_ground, bool is_tree = false) : dense(Eigen::MatrixXd::Zero(2 * count, 2 * count)) {
    std::mt19937 random(7);
    std::uniform_real_distribution<double> entry(-1, 1);
    std::uniform_int_distribution<int> any(0, count - 1);
    dense.diagonal().setConstant(to_ground);
    for (int b = 1; b < count; ++b) {
      for (const int other : is_tree ? std::vector{b / 2} : std::vector{b - 1, any(random) % b, any(random) % b}) {
        Eigen::Matrix2d half;
        half << entry(random), entry(random), entry(random), entry(random);
        const Eigen::Matrix2d spring = half * half.transpose() + 0.1 * Eigen::Matrix2d::Identity();
        const int one = is_tree ? count - 1 - b : b, two = is_tree ? count - 1 - other : other;
        for (const auto& [i, j, sign] :
             {std::tuple{one, one, 1.0}, {two, two, 1.0}, {one, two, -1.0}, {two, one, -1.0}})
          dense.block<2, 2>(2 * i, 2 * j) += sign * spring;
      }
    }
    for (int c = 0; c < count; ++c) {
      for (int r = 0; r <= c; ++r) {
        const Eigen::Matrix2d block = dense.block<2, 2>(2 * r, 2 * c);
        if (r < c && block.isZero(0)) continue;
        blocks.rows.push_back(r);
        blocks.blocks.push_back(block);
      }
      blocks.starts.push_back(static_cast<int>(blocks.rows.size()));
    }
  }
};

TEST(BlockCholesky, SolvesWhatADenseFactorizationSolves) {
  const Springs springs(60, 0.3);
  ASSERT_LT(springs.blocks.blocks.size(), 300u);  // sparse
  const Eigen::VectorXd b = Eigen::VectorXd::LinSpaced(120, -1, 2);
  const Eigen::VectorXd x = BlockCholesky(springs.blocks).solve(b), expected = springs.dense.llt().solve(b);
  EXPECT_LT((x - expected).norm(), 1e-12 * expected.norm());
}

TEST(BlockCholesky, SolvesWithinBlocksAsInAll) {
  for (const bool is_tree : {false, true}) {
    const Springs springs(60, 0.3, is_tree);
    const BlockCholesky factors(springs.blocks);
    for (const std::vector<int>& blocks : {std::vector{59}, {0}, {3, 17, 18, 44}, {44, 3}, {44, 3, 44}, {}})
      for (const int columns : {0, 1, 5}) {
        std::vector<int> rows;
        for (const int block : blocks) rows.insert(rows.end(), {2 * block, 2 * block + 1});
        const auto count = static_cast<Eigen::Index>(rows.size());
        const BlockCholesky::Columns b = Eigen::MatrixXd::NullaryExpr(
            count, columns, [](Eigen::Index i, Eigen::Index j) { return std::sin(7. * i + j + 1); });
        Eigen::MatrixXd all = Eigen::MatrixXd::Zero(120, columns);
        for (Eigen::Index i = 0; i < count; ++i) all.row(rows[i]) += b.row(i);
        const Eigen::MatrixXd x = factors.solve_within(blocks, b), expected = springs.dense.llt().solve(all);
        ASSERT_EQ(x.rows(), count);
        ASSERT_EQ(x.cols(), columns);
        EXPECT_LE((x - expected(rows, Eigen::all)).norm(), 1e-12 * expected.norm());
      }
  }
}

TEST(BlockCholesky, SolvesASingleBlock) {
  BlockMatrix matrix;
  matrix.rows = {0};
  matrix.starts = {0, 1};
  matrix.blocks.emplace_back();
  matrix.blocks[0] << 2, 1, 1, 3;
  const Vector x = BlockCholesky(matrix).solve(Eigen::Vector2d(5, 10));
  EXPECT_NEAR(x[0], 1, 1e-15);
  EXPECT_NEAR(x[1], 3, 1e-15);
}

TEST(BlockCholesky, RefusesWhatNothingHolds) {
  // Without the ground the springs move as a whole.
  EXPECT_THROW(BlockCholesky{Springs(60, 0).blocks}, std::runtime_error);
  Springs pushed(60, 0.3);
  pushed.blocks.blocks[pushed.blocks.find(59, 59)].setConstant(-1);
  EXPECT_THROW(BlockCholesky{pushed.blocks}, std::runtime_error);
}

}  // namespace
}  // namespace sprekk::fine_fracture
