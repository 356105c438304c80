// Independent parts of a system are factorized and solved by themselves.
#include "framework/linear/reduction/separated_solver.hpp"

#include <gtest/gtest.h>

#include "tests/framework/linear/test_systems.hpp"

namespace sprekk {
namespace {

std::unique_ptr<LinearSolver> make() {
  return std::make_unique<SeparatedSolver>([] {
    LinearOptions options;
    options.type = "umfpack";
    return make_linear_solver(options);
  });
}

/// Two Laplacians of different size whose unknowns come in three blocks, the first and the last of one problem.
LinearSystem two_problems(double factor, double link = 0) {
  constexpr int n = 12, m = 7;
  const LinearSystem large = test::poisson(n), small = test::poisson(m);
  std::vector<Triplet> entries;
  const int first = n * n / 2;  // unknowns of the large one before those of the small one
  const auto place = [&](int i) { return i < first ? i : i + m * m; };
  for (int row = 0; row < n * n; ++row)
    for (SparseMatrix::InnerIterator entry(large.local, row); entry; ++entry)
      entries.emplace_back(place(row), place(static_cast<int>(entry.col())), entry.value());
  for (int row = 0; row < m * m; ++row)
    for (SparseMatrix::InnerIterator entry(small.local, row); entry; ++entry)
      entries.emplace_back(first + row, first + static_cast<int>(entry.col()), factor * entry.value());
  if (link != 0) entries.emplace_back(0, first, link);
  return test::make_system(n * n + m * m, entries,
                           {{"a", 0, first, 1, BlockKind::bulk_elliptic, {}, {}},
                            {"b", first, m * m, 1, BlockKind::bulk_elastic, {}, {}},
                            {"c", first + m * m, n * n - first, 1, BlockKind::bulk_elliptic, {}, {}}});
}

Vector solve(LinearSolver& solver, const LinearSystem& system, const Vector& b) {
  EXPECT_TRUE(solver.factor(system).solved);
  Vector x;
  EXPECT_TRUE(solver.solve(b, x).solved);
  return x;
}

TEST(SeparatedSolver, SolvesBothParts) {
  const LinearSystem system = two_problems(1e-9);
  const Vector exact = test::random_vector(static_cast<int>(system.rows.size()), 1);
  const auto solver = make();
  EXPECT_LT((solve(*solver, system, system.local * exact) - exact).lpNorm<Eigen::Infinity>(), 1e-11);
  EXPECT_EQ(solver->counts().factorizations, 2);
  EXPECT_EQ(solver->counts().solves, 2);
}

/// A Laplacian of 12 × 12 entities, every third of which has a diagonal entry alone, with two unknowns an entity in one
/// block.
LinearSystem with_lone_entities(double diagonal) {
  constexpr int n = 12, components = 2;
  const LinearSystem whole = test::poisson(n);
  std::vector<Triplet> entries;
  for (int row = 0; row < n * n; ++row)
    for (SparseMatrix::InnerIterator entry(whole.local, row); entry; ++entry)
      for (int k = 0; k < components; ++k) {
        const auto column = static_cast<int>(entry.col());
        const bool is_lone = row % 3 == 0 || column % 3 == 0;
        if (is_lone && row != column) continue;
        entries.emplace_back(components * row + k, components * column + k, is_lone ? diagonal : entry.value());
        if (!is_lone && row == column) entries.emplace_back(components * row + k, components * row + 1 - k, 0.1);
      }
  return test::make_system(components * n * n, entries,
                           {{"a", 0, n * n, components, BlockKind::bulk_elliptic, {}, {}}});
}

TEST(SeparatedSolver, SolvesLoneEntitiesApart) {
  std::vector<int> sizes;
  class Recorder final : public LinearSolver {
   public:
    explicit Recorder(std::vector<int>& sizes) : sizes_(sizes) {}
    LinearReport factor(const LinearSystem& system) override {
      sizes_.push_back(static_cast<int>(system.local.rows()));
      return solver_->factor(system);
    }
    LinearReport solve(const Vector& b, Vector& x) override { return solver_->solve(b, x); }
    std::string name() const override { return "recorder"; }

   private:
    std::vector<int>& sizes_;
    std::unique_ptr<LinearSolver> solver_ = make();
  };
  SeparatedSolver solver([&] { return std::make_unique<Recorder>(sizes); });
  for (const double diagonal : {5.0, 1e-12, 5.0}) {
    const LinearSystem system = with_lone_entities(diagonal);
    const Vector exact = test::random_vector(static_cast<int>(system.rows.size()), 4);
    EXPECT_LT((solve(solver, system, system.local * exact) - exact).lpNorm<Eigen::Infinity>(), 1e-12);
    EXPECT_EQ(sizes.back(), 2 * 96);
  }
  // A singular one is left to the solver, which says so.
  EXPECT_FALSE(solver.factor(with_lone_entities(0)).solved);
  EXPECT_EQ(sizes.back(), 2 * 144);
}

TEST(SeparatedSolver, FactorizesOnlyThePartThatChanged) {
  const LinearSystem first = two_problems(1), second = two_problems(3);
  const Vector exact = test::random_vector(static_cast<int>(first.rows.size()), 2);
  const auto solver = make();
  solve(*solver, first, first.local * exact);
  EXPECT_LT((solve(*solver, second, second.local * exact) - exact).lpNorm<Eigen::Infinity>(), 1e-11);
  EXPECT_EQ(solver->counts().factorizations, 3);
  EXPECT_EQ(solver->counts().reused, 1);
}

TEST(SeparatedSolver, DoesNotSolveForAPartWithoutLoad) {
  const LinearSystem system = two_problems(1);
  Vector exact = test::random_vector(static_cast<int>(system.rows.size()), 3);
  exact.segment(72, 49).setZero();
  const auto solver = make();
  EXPECT_LT((solve(*solver, system, system.local * exact) - exact).lpNorm<Eigen::Infinity>(), 1e-11);
  EXPECT_EQ(solver->counts().solves, 1);
}

TEST(SeparatedSolver, PassesOnePartOn) {
  const LinearSystem joined = two_problems(1, 0.5);
  const Vector exact = test::random_vector(static_cast<int>(joined.rows.size()), 4);
  const auto solver = make();
  EXPECT_LT((solve(*solver, joined, joined.local * exact) - exact).lpNorm<Eigen::Infinity>(), 1e-11);
  EXPECT_EQ(solver->counts().factorizations, 1);
  EXPECT_LT((solve(*solver, two_problems(1), two_problems(1).local * exact) - exact).lpNorm<Eigen::Infinity>(), 1e-11);
  EXPECT_EQ(solver->counts().factorizations, 3);
}

/// Systems with the same number have the same entries: these are compared only where the number is new.
TEST(SeparatedSolver, BelievesTheNumbersOfSystems) {
  LinearSystem first = two_problems(1), second = two_problems(3);
  first.pattern_number = second.pattern_number = new_system_number();
  first.number = new_system_number();
  second.number = new_system_number();
  const Vector exact = test::random_vector(static_cast<int>(first.rows.size()), 2);
  const auto solver = make();
  solve(*solver, first, first.local * exact);
  LinearSystem renumbered = first;
  renumbered.number = new_system_number();
  solve(*solver, renumbered, first.local * exact);
  solve(*solver, first, first.local * exact);
  EXPECT_EQ(solver->counts().factorizations, 2);
  EXPECT_EQ(solver->counts().reused, 4);
  EXPECT_LT((solve(*solver, second, second.local * exact) - exact).lpNorm<Eigen::Infinity>(), 1e-11);
  EXPECT_EQ(solver->counts().factorizations, 3);
}

}  // namespace
}  // namespace sprekk
