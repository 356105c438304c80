// The Schur complement of a bulk is that of a dense elimination, and the same whether all of it is kept or not.
#include "framework/linear/reduction/bulk_schur_complement.hpp"

#include <gtest/gtest.h>

#include <Eigen/LU>
#include <cmath>
#include <utility>

#include "tests/framework/linear/test_systems.hpp"

namespace sprekk {
namespace {

const LinearSystem fractured = test::FracturedBiot{12}.build();

struct Way {
  const char* type;
  bool is_short_lived;  ///< with MUMPS: found while it factorizes
};

class ShortLivedSchurComplement : public testing::Test {
 protected:
  ShortLivedSchurComplement() { split.update(fractured.local); }
  BulkSplitting split{fractured};
};

class SchurComplementOf : public testing::TestWithParam<Way> {
 protected:
  SchurComplementOf() {
    split.update(fractured.local);
    LinearOptions options;
    options.type = GetParam().type;
    solver = make_linear_solver(options);
  }
  BulkSchurComplement computed(BulkSchurComplement schur, bool is_short_lived = GetParam().is_short_lived) {
    EXPECT_TRUE(schur.compute(split, *solver, is_short_lived).solved);
    return schur;
  }
  /// A_FB A_BB^-1 A_BF by dense elimination, for interface rows and columns.
  Eigen::MatrixXd exact_rows() const {
    const Eigen::MatrixXd dense =
        split.fb.matrix * Eigen::MatrixXd(split.bb()).partialPivLu().solve(Eigen::MatrixXd(split.bf.matrix));
    return dense(split.interface_rows, split.interface_columns);
  }
  const BulkSchurComplement kept{1e9}, in_pieces{0, 32};  // X has 65 columns

  BulkSplitting split{fractured};
  std::unique_ptr<LinearSolver> solver;
};

TEST_P(SchurComplementOf, IsThatOfADenseElimination) {
  BulkSchurComplement schur = computed(kept);
  const Eigen::MatrixXd exact = exact_rows();
  const BulkSchurComplement::RowMatrix& rows = *schur.schur_rows(split, *solver);
  ASSERT_EQ(rows.rows(), exact.rows());
  ASSERT_EQ(rows.cols(), exact.cols());
  for (int k = 0; k < rows.rows(); ++k) EXPECT_LT((rows.row(k) - exact.row(k)).norm(), 1e-9 * exact.row(k).norm()) << k;
}

TEST_P(SchurComplementOf, HasTheSameBitsInPieces) {
  BulkSchurComplement whole = computed(kept, false), pieces = computed(in_pieces, false);
  EXPECT_TRUE(whole.is_whole());
  EXPECT_FALSE(pieces.is_whole());
  EXPECT_EQ(*whole.schur_rows(split, *solver), *pieces.schur_rows(split, *solver));
}

TEST_P(SchurComplementOf, SubtractsByABackSolveWhereItIsNotKept) {
  const BulkSchurComplement whole = computed(kept, false), pieces = computed(in_pieces);
  const Vector local = test::random_vector(split.local_size(), 3);
  Vector multiplied = Vector::Zero(split.bulk_size()), solved = multiplied;
  whole.subtract(split, *solver, local, multiplied);
  pieces.subtract(split, *solver, local, solved);
  EXPECT_LT(test::block_difference(split.bulk_system(), solved, multiplied), 1e-9);
}

TEST_P(SchurComplementOf, FollowsRowsThatChange) {
  BulkSchurComplement schur = computed(kept);
  const BulkSchurComplement::RowMatrix before = *schur.schur_rows(split, *solver);
  const std::size_t changed = split.interface_rows.size() / 2;
  split.fb.matrix.row(split.interface_rows[changed]) *= 2.0;
  BulkSchurComplement::RowMatrix expected = before;
  expected.row(changed) *= 2.0;
  EXPECT_EQ(*schur.schur_rows(split, *solver), expected);
}

TEST_P(SchurComplementOf, FollowsARowOfWhichOneEntryChanges) {
  BulkSchurComplement schur = computed(kept);
  schur.schur_rows(split, *solver);
  const int changed = static_cast<int>(split.interface_rows.size()) / 2;
  split.fb.matrix.valuePtr()[split.fb.matrix.outerIndexPtr()[split.interface_rows[changed]]] *= 3;
  const Eigen::MatrixXd exact = exact_rows();
  const BulkSchurComplement::RowMatrix& rows = *schur.schur_rows(split, *solver);
  EXPECT_LT((rows.row(changed) - exact.row(changed)).norm(), 1e-9 * exact.row(changed).norm());
}

// Else a run that goes on from a checkpoint would not have the bits of one that was not interrupted.
TEST_P(SchurComplementOf, DoesNotRememberWithWhichScalesOfRowsItWasComputed) {
  BulkSchurComplement::RowMatrix expected = *computed(kept).schur_rows(split, *solver);
  const SparseMatrix rows = split.fb.matrix;
  for (int k = 0; k < static_cast<int>(split.interface_rows.size()); ++k)
    split.fb.matrix.row(split.interface_rows[k]) *= std::ldexp(1.0, k % 60 - 30);
  BulkSchurComplement schur = computed(kept);
  split.fb.matrix = rows;
  EXPECT_EQ(*schur.schur_rows(split, *solver), expected);
}

/// MUMPS, until something else than the first border is asked for.
class BordersOnce : public LinearSolver {
 public:
  BordersOnce() {
    LinearOptions options;
    options.type = "mumps";
    solver_ = make_linear_solver(options);
  }
  LinearReport factor(const LinearSystem& system) override { return solver_->factor(system); }
  LinearReport solve(const Vector& b_rows, Vector& x) override { return solver_->solve(b_rows, x); }
  std::optional<LinearReport> factor_bordered(const LinearSystem& system, const SparseMatrix& columns,
                                              const SparseMatrix& rows, Eigen::MatrixXd& schur) override {
    if (std::exchange(has_bordered_, true)) return LinearReport::failure("no memory is left");
    return solver_->factor_bordered(system, columns, rows, schur);
  }
  std::string name() const override { return "borders once"; }

 private:
  std::unique_ptr<LinearSolver> solver_;
  bool has_bordered_ = false;
};

TEST_F(ShortLivedSchurComplement, IsNoneWhereRowsChangeAndTheFactorizationFails) {
  BordersOnce solver;
  BulkSchurComplement schur;
  ASSERT_TRUE(schur.compute(split, solver, true).solved);
  ASSERT_NE(schur.schur_rows(split, solver), nullptr);
  split.fb.matrix.valuePtr()[split.fb.matrix.outerIndexPtr()[split.interface_rows[0]]] *= 3;
  EXPECT_EQ(schur.schur_rows(split, solver), nullptr);
}

TEST_P(SchurComplementOf, LeavesASolverThatSolves) {
  computed(kept);
  Vector exact = test::random_vector(split.bulk_size(), 5);  // displacements (m), then pressures (Pa)
  exact.head(2 * split.bulk_size() / 3) *= 1e-4;
  exact.tail(split.bulk_size() / 3) *= 1e6;
  Vector x;
  ASSERT_TRUE(solver->solve(split.bb() * exact, x).solved);
  EXPECT_LT(test::block_difference(split.bulk_system(), x, exact), 1e-9);
  ASSERT_TRUE(solver->factor(split.bulk_system()).solved);
  ASSERT_TRUE(solver->solve(split.bb() * exact, x).solved);
  EXPECT_LT(test::block_difference(split.bulk_system(), x, exact), 1e-9);
}

TEST_P(SchurComplementOf, IsRefusedWhereTheBulkIsSingular) {
  for (SparseMatrix::InnerIterator entry(split.bb(), 7); entry; ++entry) entry.valueRef() = 0;
  BulkSchurComplement schur = kept;
  const LinearReport report = schur.compute(split, *solver, GetParam().is_short_lived);
  EXPECT_FALSE(report.solved);
  EXPECT_NE(report.reason.find("singular"), std::string::npos) << report.reason;
}

TEST_F(ShortLivedSchurComplement, NeedsNoColumns) {
  LinearOptions options;
  options.type = "mumps";
  const std::unique_ptr<LinearSolver> solver = make_linear_solver(options);
  BulkSchurComplement schur;
  ASSERT_TRUE(schur.compute(split, *solver, true).solved);
  schur.schur_rows(split, *solver);
  EXPECT_FALSE(schur.is_whole());
  EXPECT_EQ(solver->counts().columns, 0);
  EXPECT_EQ(solver->counts().factorizations, 1);
}

INSTANTIATE_TEST_SUITE_P(Ways, SchurComplementOf,
                         testing::Values(Way{"umfpack", false}, Way{"umfpack", true}, Way{"mumps", false},
                                         Way{"mumps", true}),
                         [](const auto& info) {
                           return std::string(info.param.type) + (info.param.is_short_lived ? "_short_lived" : "");
                         });

}  // namespace
}  // namespace sprekk
