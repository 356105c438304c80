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

}  // namespace
}  // namespace sprekk::test
