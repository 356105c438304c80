// What a multigrid of potentials is given: the rows' sums stay, and so does every path between unknowns.
#include "framework/linear/iterative/without_small_entries.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <Eigen/LU>
#include <cmath>
#include <numeric>

#include "tests/framework/linear/test_systems.hpp"

namespace sprekk {
namespace {

SparseMatrix filtered(const SparseMatrix& a) {
  std::vector<int> ids(a.rows());
  std::iota(ids.begin(), ids.end(), 0);
  return without_small_entries(a, ids);
}

/// Exchange between unknowns: each row has the sum of its exchanges on the diagonal.
SparseMatrix balances(int unknowns, const std::vector<Triplet>& links) {
  std::vector<Triplet> entries;
  for (const Triplet& link : links)
    for (const auto& [i, j] : {std::pair{link.row(), link.col()}, {link.col(), link.row()}}) {
      entries.emplace_back(i, j, -link.value());
      entries.emplace_back(i, i, link.value());
    }
  SparseMatrix a(unknowns, unknowns);
  a.setFromTriplets(entries.begin(), entries.end());
  return a;
}

/// A chain in which each unknown also has weak links to a hundred others, of both signs.
SparseMatrix far_reaching(int unknowns, double weak) {
  std::vector<Triplet> links;
  for (int i = 0; i < unknowns; ++i) {
    if (i + 1 < unknowns) links.emplace_back(i, i + 1, 1 + 0.3 * (i % 4));
    for (int k = 2; k < 100; ++k) links.emplace_back(i, (i + 7 * k) % unknowns, k % 3 == 0 ? -weak : weak);
  }
  SparseMatrix a = balances(unknowns, links);
  for (int i = 0; i < unknowns; ++i) a.coeffRef(i, i) += 0.01 * (1 + i % 5);  // what is stored
  return a;
}

TEST(WithoutSmallEntries, RowsKeepTheirSumsAndTheirLargeEntries) {
  const SparseMatrix a = far_reaching(300, 2e-4), b = filtered(a);
  EXPECT_GT(a.nonZeros(), 50 * 300);
  EXPECT_LT(b.nonZeros(), 4 * 300);
  const Vector ones = Vector::Ones(300);
  EXPECT_LT((a * ones - b * ones).lpNorm<Eigen::Infinity>(), 1e-13);
  for (int i = 0; i + 1 < 300; ++i) EXPECT_EQ(b.coeff(i, i + 1), a.coeff(i, i + 1)) << i;
  // What is left is nearly the same: corrections by its inverse converge.
  const Eigen::PartialPivLU<Eigen::MatrixXd> inverse{Eigen::MatrixXd(b)};
  const Vector load = Vector::LinSpaced(300, -1, 2);
  Vector x = Vector::Zero(300);
  for (int k = 0; k < 20; ++k) x += inverse.solve(load - a * x);
  EXPECT_LT((load - a * x).norm(), 1e-6 * load.norm());
}

// Entries between rock and a fracture that conducts a million times better are small in the fracture's rows, but all
// that holds it.
TEST(WithoutSmallEntries, WhatConductsWellStaysLinkedToWhatDoesNot) {
  std::vector<Triplet> links;
  for (int i = 0; i < 9; ++i) links.emplace_back(i, i + 1, i < 5 ? 1e6 : 1);
  SparseMatrix a = balances(10, links);
  a.coeffRef(9, 9) += 1;
  EXPECT_EQ((Eigen::MatrixXd(filtered(a)) - Eigen::MatrixXd(a)).lpNorm<Eigen::Infinity>(), 0);
}

TEST(WithoutSmallEntries, ARowThatWouldLoseHalfOfItsDiagonalStaysWhole) {
  // Each of 900 entries is small, all together they are 0.6 of the diagonal.
  std::vector<Triplet> links;
  for (int k = 1; k <= 900; ++k) links.emplace_back(0, k, 1);
  SparseMatrix a = balances(901, links);
  for (int k = 0; k <= 900; ++k) a.coeffRef(k, k) += k == 0 ? 600 : 2000;
  const SparseMatrix b = filtered(a);
  EXPECT_EQ(b.row(0).nonZeros(), 901);
  EXPECT_EQ(b.coeff(0, 0), a.coeff(0, 0));
  EXPECT_EQ(b.row(5).nonZeros(), 1);
  EXPECT_DOUBLE_EQ(b.coeff(5, 5), a.coeff(5, 5) - 1);
}

TEST(WithoutSmallEntries, GmresTakesAsFewIterations) {
  const auto iterations = [](const SparseMatrix& far) {
    LinearSystem system = test::poisson(60);
    system.local = SparseMatrix(system.local + far);
    LinearOptions options;
    options.type = "belos";
    const auto solver = make_linear_solver(options);
    EXPECT_TRUE(solver->factor(system).solved);
    Vector x;
    const LinearReport report = solver->solve(Vector::Ones(3600), x);
    EXPECT_TRUE(report.solved) << report.reason;
    EXPECT_LT((system.local * x - Vector::Ones(3600)).norm(), 1e-8 * std::sqrt(3600));
    return report.iterations;
  };
  std::vector<Triplet> links;
  for (int i = 0; i < 3600; ++i)
    for (int k = 1; k < 60; ++k) links.emplace_back(i, (i + 60 * (k % 8) + k) % 3600, k % 2 == 0 ? -1e-4 : 1e-4);
  EXPECT_LE(iterations(balances(3600, links)), iterations(SparseMatrix(3600, 3600)) + 5);
}

}  // namespace
}  // namespace sprekk
