// Values of a long list in a shorter one, piece by piece.
#include "framework/linear/reduction/excerpt.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <vector>

namespace sprekk {
namespace {

const std::vector<int> places{2, 3, 4, 7, 6, 9};  // three that follow one another, then single ones, one backwards

struct ExcerptOfTen : testing::Test {
  ExcerptOfTen() {
    for (const int place : places) excerpt.add(place);
    for (int k = 0; k < 10; ++k) whole.push_back(1.5 * k);
    EXPECT_TRUE(excerpt.take(whole.data(), mine.data()));
  }
  Excerpt excerpt;
  std::vector<double> whole, mine = std::vector<double>(places.size(), std::nan(""));
};

TEST_F(ExcerptOfTen, HasTheValuesOfItsPlaces) {
  ASSERT_EQ(excerpt.size(), places.size());
  for (std::size_t k = 0; k < places.size(); ++k) EXPECT_EQ(mine[k], whole[places[k]]) << k;
}

TEST_F(ExcerptOfTen, SeesEachBitThatChangesAtItsPlaces) {
  EXPECT_FALSE(excerpt.differs(whole.data(), mine.data()));
  EXPECT_FALSE(excerpt.take(whole.data(), mine.data()));
  for (int k = 0; k < 10; ++k) {
    std::vector<double> other = whole, taken = mine;
    other[k] = std::nextafter(other[k], 100);
    const bool is_mine = std::count(places.begin(), places.end(), k) > 0;
    EXPECT_EQ(excerpt.differs(other.data(), taken.data()), is_mine) << k;
    EXPECT_EQ(excerpt.take(other.data(), taken.data()), is_mine) << k;
    EXPECT_FALSE(excerpt.differs(other.data(), taken.data())) << k;
  }
  std::vector<double> zero = whole;
  zero[7] = 0;
  excerpt.take(zero.data(), mine.data());
  zero[7] = -0.0;
  EXPECT_TRUE(excerpt.differs(zero.data(), mine.data()));
}

TEST_F(ExcerptOfTen, PutsValuesBackAndLeavesTheOthers) {
  std::vector<double> other(10, -1);
  excerpt.put_back(mine.data(), other.data());
  for (int k = 0; k < 10; ++k)
    EXPECT_EQ(other[k], std::count(places.begin(), places.end(), k) > 0 ? whole[k] : -1) << k;
}

}  // namespace
}  // namespace sprekk
