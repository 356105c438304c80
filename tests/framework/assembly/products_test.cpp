// Products that are kept are those that would be computed, in all bits, whatever happens to the field.
#include "framework/assembly/products.hpp"

#include <gtest/gtest.h>

namespace sprekk {
namespace {

constexpr int n = 40;

Operator some_matrix(double scale) {
  std::vector<Triplet> entries;
  for (int i = 0; i < n; ++i)
    for (int j = i % 3; j < n; j += 3) entries.emplace_back(i, j, scale / (1 + i + 2 * j) - 0.01);
  SparseMatrix matrix(n, n);
  matrix.setFromTriplets(entries.begin(), entries.end());
  return Operator(std::move(matrix));
}

Vector some_values(double start) { return Vector::LinSpaced(n, start, start + 1).array().sin(); }

struct KeptProducts : testing::Test {
  Field field{{.owner = "a",
               .name = "b",
               .location = Location::cell,
               .role = Role::unknown(BlockKind::interface),
               .unit = "",
               .doc = ""},
              n};
  Operator a = some_matrix(1), other = some_matrix(3);
  Products products;

  void expect_right(const Operator& matrix) {
    EXPECT_EQ(products.value_now(matrix, field), multiply(matrix.entries(), field.now(), false).value);
    EXPECT_EQ(products.now(matrix, field).value, multiply(matrix.entries(), field.now()).value);
    EXPECT_EQ(products.now(matrix, field).size, multiply(matrix.entries(), field.now()).size);
  }
};

TEST_F(KeptProducts, FollowTheField) {
  expect_right(a);
  field.set_both(some_values(1));
  expect_right(a);
  field.set(some_values(2));
  expect_right(a);
  expect_right(other);
  field.set(some_values(3));
  expect_right(a);
  field.rewind();
  expect_right(a);
  field.set(some_values(4));
  field.accept();
  expect_right(a);
  field.set_accepted(some_values(5));
  expect_right(a);
  field.accept();
  expect_right(a);
  field.set_accepted(some_values(6));
  field.rewind();
  expect_right(a);
}

TEST_F(KeptProducts, OfAnAcceptedStateServeTheNextStep) {
  field.set(some_values(1));
  const double* computed = products.value_now(a, field).data();
  field.accept();
  EXPECT_EQ(products.value_now(a, field).data(), computed);
}

TEST_F(KeptProducts, AreThoseOfTheMatrixThatAPartHasNow) {
  field.set(some_values(1));
  expect_right(a);
  a = some_matrix(7);
  expect_right(a);
  products.forget_unused();
  products.forget_unused();
  expect_right(a);
}

TEST(Operator, SharesItsNumberWithCopiesOnly) {
  const Operator a = some_matrix(1), same = some_matrix(1), copy = a;
  EXPECT_EQ(copy.number(), a.number());
  EXPECT_NE(same.number(), a.number());
  EXPECT_NE(Operator().number(), 0u);
}

}  // namespace
}  // namespace sprekk
