// A system is assembled anew when one of its terms has changed, and has a new number then.
#include "framework/assembly/block_system.hpp"

#include <gtest/gtest.h>

#include "tests/framework/assembly/small_mesh.hpp"

namespace sprekk {
namespace {

struct Blocks : testing::Test {
  const Mesh mesh = test::small_mesh(0.4);
  const int n = mesh.cell_count();
  Field p{{.owner = "a",
           .name = "p",
           .location = Location::cell,
           .role = Role::unknown(BlockKind::interface),
           .unit = "",
           .doc = ""},
          n};
  Field q{{.owner = "a",
           .name = "q",
           .location = Location::cell,
           .role = Role::unknown(BlockKind::interface),
           .unit = "",
           .doc = ""},
          n};
  BlockSystem system{mesh, {&p, &q}};
  Operator steady = chain(1), coupling = chain(0.5);

  /// The terms of the equations: p depends on itself by `steady`, on q by `coupling`, and q on what is computed anew.
  double dt = 1, entry = 2, weight = 1, scale_of_fixed = 0;
  bool is_wide = false;

  Operator chain(double scale) const {
    std::vector<Triplet> entries;
    for (int i = 0; i + 1 < n; ++i) entries.emplace_back(i, i + 1, scale * (1 + i));
    SparseMatrix matrix(n, n);
    matrix.setFromTriplets(entries.begin(), entries.end());
    return Operator(std::move(matrix));
  }

  LinearSystem assemble() {
    Assembly assembly({&p, &q}, Assembly::Request::residual_and_derivatives);
    const Vector weights = Vector::Constant(n, weight);
    assembly.diagonal(p, p, Vector::Constant(n, 5));
    assembly.linear(p, steady, p, dt);
    assembly.linear(p, coupling, q, 1, &weights);
    assembly.diagonal(q, q, Vector::Constant(n, entry));
    if (is_wide) assembly.derivative(q, p, SparseMatrix(chain(2).entries()));
    if (scale_of_fixed != 0) assembly.fix(q, 1, 0, scale_of_fixed);
    return system.matrix(assembly);
  }

  /// The matrix, from its definition.
  Eigen::MatrixXd expected() const {
    Eigen::MatrixXd whole = Eigen::MatrixXd::Zero(2 * n, 2 * n);
    whole.topLeftCorner(n, n) = 5 * Eigen::MatrixXd::Identity(n, n) + dt * Eigen::MatrixXd(steady.entries());
    whole.topRightCorner(n, n) = weight * Eigen::MatrixXd(coupling.entries());
    if (is_wide) whole.bottomLeftCorner(n, n) = Eigen::MatrixXd(chain(2).entries());
    whole.bottomRightCorner(n, n) = entry * Eigen::MatrixXd::Identity(n, n);
    if (scale_of_fixed != 0) {
      whole.row(n + 1).setZero();
      whole(n + 1, n + 1) = scale_of_fixed;
    }
    return whole;
  }
};

TEST_F(Blocks, KeepTheirNumberWhileNothingChanges) {
  const LinearSystem first = assemble(), second = assemble();
  EXPECT_NE(first.number, 0u);
  EXPECT_EQ(second.number, first.number);
  EXPECT_EQ(Eigen::MatrixXd(second.local), expected());
  EXPECT_EQ(system.patterns_built(), 1);
}

TEST_F(Blocks, ChangeTheirNumberWithEveryValue) {
  std::uint64_t last = assemble().number;
  const std::uint64_t pattern = assemble().pattern_number;
  const auto expect_new = [&](const char* what) {
    const LinearSystem next = assemble();
    EXPECT_NE(next.number, last) << what;
    EXPECT_EQ(next.pattern_number, pattern) << what;
    EXPECT_EQ(Eigen::MatrixXd(next.local), expected()) << what;
    last = next.number;
    EXPECT_EQ(assemble().number, last) << what;
  };
  dt = 0.5;
  expect_new("the factor of a block that stays");
  entry = 3;
  expect_new("an entry of a block that is computed anew");
  weight = 4;
  expect_new("the weight of a row");
  scale_of_fixed = 2;
  expect_new("a value that is prescribed");
  scale_of_fixed = 7;
  expect_new("its scale");
  dt = 0.25;
  expect_new("another equation than the one with the value that is prescribed");
  entry = 4;
  expect_new("the equation with the value that is prescribed");
  scale_of_fixed = 0;
  expect_new("a value that is not prescribed any more");
  system.set_stabilization(p, Vector::Ones(n));
  expect_new("the stabilization of a preconditioner");
  EXPECT_EQ(system.patterns_built(), 1);
}

TEST_F(Blocks, SeeAnotherOperatorAndAnotherPattern) {
  const LinearSystem first = assemble();
  steady = chain(9);
  const LinearSystem other = assemble();
  EXPECT_NE(other.number, first.number);
  EXPECT_EQ(Eigen::MatrixXd(other.local), expected());
  is_wide = true;
  const LinearSystem wide = assemble();
  EXPECT_NE(wide.pattern_number, other.pattern_number);
  EXPECT_EQ(Eigen::MatrixXd(wide.local), expected());
  is_wide = false;
  EXPECT_EQ(Eigen::MatrixXd(assemble().local), expected());
}

}  // namespace
}  // namespace sprekk
