#include "framework/assembly/property.hpp"

#include <gtest/gtest.h>

#include <algorithm>

namespace sprekk {
namespace {

const std::vector<Place> places = {{Point(1, 0), 0, 0}, {Point(2, 0), 0, 0}};

TEST(Property, OfConstantDatumIsEvaluatedOnce) {
  int calls = 0;
  Property property(Data(
                        [&](const Place& place) {
                          ++calls;
                          return place.x[0];
                        },
                        false, true),
                    places, 0);
  property.evaluate({0, 1, 1});
  EXPECT_EQ(calls, 2);
  EXPECT_EQ(property.version(), 1u);
  EXPECT_EQ(property[1], 2);
}

TEST(Property, HasAnotherVersionWhenAValueIsAnother) {
  Property property(Data([](const Place& place) { return std::max(place.t, 2.0) * place.x[0]; }, true, true), places,
                    0);
  property.evaluate({0, 1, 1});
  property.evaluate({1, 1, 2});
  EXPECT_EQ(property.version(), 1u);
  property.evaluate({2, 1, 3});
  EXPECT_EQ(property.version(), 2u);
  EXPECT_EQ(property.values(), Eigen::Vector2d(3, 6));
}

/// At the start the value after a jump holds, at the end of a step the one before.
TEST(Property, TakesJumpsAsStepsDo) {
  const Data jump([](const Place& place) { return place.t < 1 ? 5.0 : 7.0; }, true, false, {1});
  EXPECT_EQ(Property(jump, places, 1)[0], 7);
  Property property(jump, places, 0);
  property.evaluate({0, 1, 1});
  EXPECT_EQ(property[0], 5);
  property.evaluate({1, 1, 2});
  EXPECT_EQ(property[0], 7);
}

TEST(Property, KeepsItsValuesWhereTheDatumHasNone) {
  const Data ends([](const Place& place) { return place.t > 1 ? throw DataError("none") : 5.0; }, true, false);
  Property property(ends, places, 0);
  EXPECT_THROW(property.evaluate({1, 1, 2}), DataError);
  EXPECT_EQ(property[0], 5);
  EXPECT_EQ(property.version(), 1u);
}

TEST(Property, TakesValuesThatAreGiven) {
  Property property;
  EXPECT_EQ(property.version(), 0u);
  property.set(Eigen::Vector2d(1, 2));
  property.set(Eigen::Vector2d(1, 2));
  EXPECT_EQ(property.version(), 1u);
}

}  // namespace
}  // namespace sprekk
