// The response of a bulk is that of a dense elimination, and the same whether all of it is kept or not.
#include "framework/linear/bulk_response.hpp"

#include <gtest/gtest.h>

#include <Eigen/LU>

#include "tests/framework/linear/test_systems.hpp"

namespace sprekk {
namespace {

const LinearSystem fractured = test::FracturedBiot{12}.build();

class ResponseOf : public testing::TestWithParam<const char*> {
 protected:
  ResponseOf() {
    split.bb.update(fractured.local.valuePtr());
    split.bf.update(fractured.local.valuePtr());
    split.fb.update(fractured.local.valuePtr());
    LinearOptions options;
    options.type = GetParam();
    solver = make_linear_solver(options);
    EXPECT_TRUE(solver->factor(split.bulk_system()).solved);
  }
  BulkResponse computed(BulkResponse response) {
    EXPECT_TRUE(response.compute(split, *solver));
    return response;
  }
  const BulkResponse kept{1e9}, in_pieces{0, 32};  // X has 65 columns

  BulkSplitting split{fractured};
  std::unique_ptr<LinearSolver> solver;
};

TEST_P(ResponseOf, IsThatOfADenseElimination) {
  BulkResponse response = computed(kept);
  const Eigen::MatrixXd dense =
      split.fb.matrix * Eigen::MatrixXd(split.bb.matrix).partialPivLu().solve(Eigen::MatrixXd(split.bf.matrix));
  ASSERT_EQ(response.felt_rows(split).rows(), static_cast<int>(split.feeling.size()));
  ASSERT_EQ(response.felt_rows(split).cols(), static_cast<int>(split.felt.size()));
  for (std::size_t k = 0; k < split.feeling.size(); ++k) {
    const Eigen::RowVectorXd exact = dense.row(split.feeling[k])(split.felt);
    EXPECT_LT((response.felt_rows(split).row(k) - exact).norm(), 1e-9 * exact.norm()) << split.feeling[k];
  }
}

TEST_P(ResponseOf, HasTheSameBitsInPieces) {
  BulkResponse whole = computed(kept), pieces = computed(in_pieces);
  EXPECT_TRUE(whole.is_whole());
  EXPECT_FALSE(pieces.is_whole());
  EXPECT_EQ(whole.felt_rows(split), pieces.felt_rows(split));
}

TEST_P(ResponseOf, SubtractsByABackSolveWhereItIsNotKept) {
  const BulkResponse whole = computed(kept), pieces = computed(in_pieces);
  const Vector local = test::random_vector(split.local_size(), 3);
  Vector multiplied = Vector::Zero(split.bulk_size()), solved = multiplied;
  whole.subtract(split, *solver, local, multiplied);
  pieces.subtract(split, *solver, local, solved);
  EXPECT_LT(test::block_difference(split.bulk_system(), solved, multiplied), 1e-9);
}

TEST_P(ResponseOf, FollowsRowsThatChange) {
  BulkResponse response = computed(kept);
  const BulkResponse::RowMatrix before = response.felt_rows(split);
  const std::size_t changed = split.feeling.size() / 2;
  split.fb.matrix.row(split.feeling[changed]) *= 2.0;
  BulkResponse::RowMatrix expected = before;
  expected.row(changed) *= 2.0;
  EXPECT_EQ(response.felt_rows(split), expected);
}

INSTANTIATE_TEST_SUITE_P(Types, ResponseOf, testing::Values("umfpack", "mumps"),
                         [](const auto& info) { return std::string(info.param); });

}  // namespace
}  // namespace sprekk
