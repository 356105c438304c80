// The negative eigenvalue nearest to zero of a condensed matrix, against the dense Schur complement.
#include "framework/linear/condensed_eigenpair.hpp"

#include <gtest/gtest.h>

#include <Eigen/Eigenvalues>
#include <Eigen/LU>
#include <algorithm>
#include <cmath>
#include <limits>

namespace sprekk {
namespace {

/// A chain of springs between walls, whose values `first` to `last` lose `weakening` of their resistance.
Eigen::MatrixXd chain(int size, int first, int last, double weakening) {
  Eigen::MatrixXd a = Eigen::MatrixXd::Zero(size, size);
  for (int i = 0; i < size; ++i) {
    a(i, i) = 2;
    if (i > 0) a(i, i - 1) = a(i - 1, i) = -1;
    if (i >= first && i <= last) a(i, i) -= weakening;
  }
  return a;
}

struct Case {
  Eigen::MatrixXd a;
  CondensedUnknowns unknowns;

  /// M = diag(1/factor) (A_cc − A_co A_oo^-1 A_oc), densely.
  Eigen::MatrixXd condensed() const {
    const auto n = static_cast<int>(a.rows());
    std::vector<int> others;
    for (int i = 0; i < n; ++i)
      if (std::find(unknowns.columns.begin(), unknowns.columns.end(), i) == unknowns.columns.end()) others.push_back(i);
    const std::vector<int>& c = unknowns.columns;
    const Eigen::MatrixXd inner = a(others, others);
    const Eigen::MatrixXd schur = a(c, c) - a(c, others) * inner.lu().solve(Eigen::MatrixXd(a(others, c)));
    return unknowns.factors.cwiseInverse().asDiagonal() * schur;
  }

  template <class Search>
  auto with_solver(const Search& search) const {
    LinearSystem system;
    system.local = a.sparseView();
    for (int i = 0; i < a.rows(); ++i) system.rows.push_back(i);
    UnknownBlock block;
    block.name = "x";
    block.entities = static_cast<int>(a.rows());
    block.coordinates.setZero(2, a.rows());
    system.blocks = {block};
    LinearOptions options;
    options.type = "umfpack";
    const auto solver = make_linear_solver(options);
    EXPECT_TRUE(solver->factor(system).solved);
    return search(*solver, system.rows);
  }

  std::optional<CondensedEigenpair> found() const {
    return with_solver([&](LinearSolver& solver, const std::vector<int>& rows) {
      return negative_eigenpair(solver, rows, static_cast<int>(a.rows()), unknowns);
    });
  }

  double smallest() const {
    return with_solver([&](LinearSolver& solver, const std::vector<int>& rows) {
      return smallest_if_positive(solver, rows, static_cast<int>(a.rows()), unknowns);
    });
  }
};

/// Every second value of a part of the chain, with factors between 1 and 2 of one sign.
Case part_of_chain(int size, double weakening, double sign) {
  Case c{sign * chain(size, size / 4, 3 * size / 4, weakening), {}};
  std::vector<double> factors;
  for (int i = size / 4; i <= 3 * size / 4; i += 2) {
    c.unknowns.rows.push_back(i);
    c.unknowns.columns.push_back(i);
    factors.push_back(sign * (1 + static_cast<double>(i) / size));
  }
  c.unknowns.factors = Eigen::Map<const Vector>(factors.data(), std::ssize(factors));
  return c;
}

TEST(NegativeEigenpair, IsThatOfTheSchurComplement) {
  for (const double sign : {1.0, -1.0})
    for (const int size : {12, 60, 200})  // with few values exactly, with many by Arnoldi's method
      for (const double weakening : {0.0, 1e-6, 0.3, 1.1}) {
        SCOPED_TRACE(testing::Message() << size << " " << weakening << " " << sign);
        const Case c = part_of_chain(size, weakening, sign);
        const Eigen::VectorXcd all = Eigen::EigenSolver<Eigen::MatrixXd>(c.condensed()).eigenvalues();
        double nearest = -std::numeric_limits<double>::infinity();
        for (const std::complex<double> value : all)
          if (value.real() < 0) nearest = std::max(nearest, value.real());
        const auto found = c.found();
        EXPECT_EQ(found.has_value(), std::isfinite(nearest));
        if (!found || size > 100) continue;
        EXPECT_NEAR(found->value / nearest, 1, 1e-6);
        EXPECT_LT((c.condensed() * found->vector - found->value * found->vector).norm(), 1e-6);
      }
}

TEST(NegativeEigenpair, IsFoundBesideLargerPositiveOnes) {
  // Two chains: one is soft and stable, the other has lost its stability by less than the first is away from it.
  Case c{Eigen::MatrixXd::Zero(40, 40), {}};
  c.a.topLeftCorner(20, 20) = 1e-3 * chain(20, 0, 0, 0);
  c.a.bottomRightCorner(20, 20) = chain(20, 5, 15, 0.5);
  for (int i = 0; i < 40; ++i) {
    c.unknowns.rows.push_back(i);
    c.unknowns.columns.push_back(i);
  }
  c.unknowns.factors = Vector::Ones(40);
  const auto found = c.found();
  ASSERT_TRUE(found);
  EXPECT_LT(found->vector.head(20).norm(), 1e-6);
  EXPECT_NEAR((c.a * found->vector).dot(found->vector), found->value, 1e-6);
}

TEST(SmallestIfPositive, IsThatOfTheSchurComplementFromBelow) {
  for (const double sign : {1.0, -1.0})
    for (const int size : {3, 12, 60, 200})
      for (const double weakening : {0.0, 1e-6, 1e-3, 0.3, 1.1}) {
        SCOPED_TRACE(testing::Message() << size << " " << weakening << " " << sign);
        const Case c = part_of_chain(size, weakening, sign);
        const double smallest = Eigen::EigenSolver<Eigen::MatrixXd>(c.condensed()).eigenvalues().real().minCoeff();
        if (smallest <= 0) {
          EXPECT_EQ(c.smallest(), 0);
          continue;
        }
        EXPECT_LE(c.smallest(), smallest * (1 + 1e-9));
        EXPECT_GT(c.smallest(), 0.8 * smallest);
      }
}

TEST(SmallestIfPositive, IsNotCertainBesideASmallLoss) {
  // The softest motion is stable; another one, stiffer, has been lost.
  Case c{Eigen::MatrixXd::Zero(40, 40), {}};
  c.a.topLeftCorner(20, 20) = 0.02 * chain(20, 0, 0, 0);
  c.a.bottomRightCorner(20, 20) = chain(20, 5, 15, 0.5);
  for (int i = 0; i < 40; ++i) {
    c.unknowns.rows.push_back(i);
    c.unknowns.columns.push_back(i);
  }
  c.unknowns.factors = Vector::Ones(40);
  EXPECT_EQ(c.smallest(), 0);
}

TEST(NegativeEigenpair, OfNothingIsNone) {
  Case c{chain(5, 0, 0, 0), {}};
  c.unknowns.factors = Vector(0);
  EXPECT_FALSE(c.found());
}

}  // namespace
}  // namespace sprekk
