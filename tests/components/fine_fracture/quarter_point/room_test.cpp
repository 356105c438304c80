#include "components/fine_fracture/quarter_point/mesh/room.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

namespace sprekk::test {
namespace {

using namespace fine_fracture;

TEST(TipRooms, ABentCrackLeavesRoomBetweenItsTips) {
  constexpr auto traction = CrackPath::Walls::traction;
  for (const double degrees : {20.0, 60.0, 90.0, 150.0}) {
    const double angle = degrees * std::numbers::pi / 180;
    const Point end(std::cos(angle), std::sin(angle));
    FineGeometry geometry;
    geometry.outline = {{-5, -5}, {5, -5}, {5, 5}, {-5, 5}};
    geometry.cracks = {{{{1, 0}, {0, 0}, end}, true, true, {traction, traction}}};
    const std::vector<TipRoom> rooms = tip_rooms(geometry, 10);
    ASSERT_EQ(rooms.size(), 2u);
    const double apart = 2 * std::sin(angle / 2);
    for (const TipRoom& room : rooms) {
      EXPECT_LE(room.radius, apart / 3 + 1e-12) << degrees;
      // The domain of an interaction integral is at least twice as wide as the rosette, and ends before the other one.
      EXPECT_LE(2 * room.radius, room.clearance + 1e-12) << degrees;
    }
  }
}

/// A crack of 2 m with a bend in the middle.
FineGeometry bent(double bend) {
  constexpr auto traction = CrackPath::Walls::traction;
  FineGeometry geometry;
  geometry.outline = {{-5, -5}, {5, -5}, {5, 5}, {-5, 5}};
  geometry.cracks = {{{{-5, 0}, {0, 0}, {std::cos(bend), std::sin(bend)}}, false, true, {traction, traction}}};
  return geometry;
}

TEST(TipRooms, AreContinuousInABend) {
  const TipRoom straight = tip_rooms(bent(0), 10, StraightPoints::end_it).at(0);
  EXPECT_DOUBLE_EQ(straight.radius, 0.5);
  EXPECT_DOUBLE_EQ(tip_rooms(bent(0), 10).at(0).straight, 6);
  for (const double bend : {1e-12, 1e-8, -1e-6, 1e-4}) {
    const TipRoom room = tip_rooms(bent(bend), 10, StraightPoints::end_it).at(0);
    EXPECT_NEAR(room.radius, straight.radius, 1e-12) << bend;
    EXPECT_NEAR(room.clearance, straight.clearance, 1e-12) << bend;
    EXPECT_NEAR(room.straight, straight.straight, 1e-12) << bend;
  }
}

TEST(TipRooms, PassAPlaceWhereWallsChange) {
  FineGeometry geometry = bent(0);
  geometry.cracks[0].walls[0] = CrackPath::Walls::jump;
  const TipRoom room = tip_rooms(geometry, 10, StraightPoints::end_it).at(0);
  EXPECT_DOUBLE_EQ(room.straight, 6);
  EXPECT_DOUBLE_EQ(room.same_walls, 1);
  EXPECT_DOUBLE_EQ(room.radius, 0.5);
}

}  // namespace
}  // namespace sprekk::test
