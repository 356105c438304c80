// Values of two processes, made whole.
#include "framework/parallel/gathered.hpp"

#include <gtest/gtest.h>

#include "framework/parallel/parallel.hpp"

namespace sprekk::parallel {
namespace {

TEST(Gathered, HasTheValuesInOrderOfRank) {
  // One value of the first process, two of the second.
  const Vector mine = is_root() ? Vector(Vector::Constant(1, 0.1)) : Vector(Eigen::Vector2d(0.2, 0.3));
  EXPECT_EQ(gathered(mine, {1, 2}), Vector(Eigen::Vector3d(0.1, 0.2, 0.3)));
  EXPECT_EQ(gathered(is_root() ? Vector() : mine, {0, 2}), Vector(Eigen::Vector2d(0.2, 0.3)));
}

TEST(WholeVectors, PutsEachValueAtItsPlace) {
  const std::vector<int> places = is_root() ? std::vector<int>{4, 0} : std::vector<int>{3, 1, 2};
  const WholeVectors vectors(places, 5);
  for (const double factor : {1.0, -1e-300, 0.1}) {
    Vector mine(places.size()), expected(5);
    for (std::size_t k = 0; k < places.size(); ++k) mine[k] = factor * (1 + places[k]);
    for (int i = 0; i < 5; ++i) expected[i] = factor * (1 + i);
    EXPECT_EQ(vectors.whole(mine), expected);
  }
}

TEST(WholeVectors, LeavesOutWhatIsBehindTheEnd) {
  const WholeVectors vectors(is_root() ? std::vector<int>{3, 0} : std::vector<int>{1, 2}, 2);
  EXPECT_EQ(vectors.whole(is_root() ? Eigen::Vector2d(9, 5) : Eigen::Vector2d(7, 9)), Vector(Eigen::Vector2d(5, 7)));
}

TEST(WholeVectors, MayHaveNothingOfOneProcess) {
  const WholeVectors vectors(is_root() ? std::vector<int>{} : std::vector<int>{1, 0}, 2);
  EXPECT_EQ(vectors.whole(is_root() ? Vector() : Vector(Eigen::Vector2d(5, 7))), Vector(Eigen::Vector2d(7, 5)));
}

TEST(TakeFromRoot, TakesListsOfAnyLength) {
  std::vector<int> list = is_root() ? std::vector<int>{3, 1, 4} : std::vector<int>{1};
  broadcast(list);
  EXPECT_EQ(list, (std::vector<int>{3, 1, 4}));
  std::vector<double> none = is_root() ? std::vector<double>{} : std::vector<double>{2.0};
  broadcast(none);
  EXPECT_TRUE(none.empty());
  Vector same = is_root() ? Vector(Eigen::Vector2d(0.1, 0.2)) : Vector(Eigen::Vector2d(9, 9));
  broadcast(same);
  EXPECT_EQ(same, Vector(Eigen::Vector2d(0.1, 0.2)));
}

}  // namespace
}  // namespace sprekk::parallel
