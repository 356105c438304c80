#include "components/fracture_flow/tpfa/mean_along.hpp"

#include <gtest/gtest.h>

#include <cmath>

namespace sprekk::fracture_flow {
namespace {

const Piece piece{Point(0.2, 0.7), Point(0.5, 0.3), 0};  // of length 1/2

double distance(const Point& x, const Point& end) { return (x - end).norm(); }

TEST(MeanAlong, IsExactForPolynomialsOfFifthOrder) {
  for (int order = 0; order <= 5; ++order) {
    const double mean =
        mean_along(piece, [&](const Point& x) { return std::pow(distance(x, piece.from) / 0.5, order); });
    EXPECT_NEAR(mean, 1.0 / (order + 1), 1e-14) << order;
  }
}

TEST(MeanAlong, CountsRootsAtTheEndsInFull) {
  // Of s^q the mean is length^q / (q + 1).
  for (const double power : {-0.5, 0.5, 1.5})
    for (const Point& end : {piece.from, piece.to}) {
      const double mean = mean_along(piece, [&](const Point& x) { return std::pow(distance(x, end), power); });
      EXPECT_NEAR(mean, std::pow(0.5, power) / (power + 1), 1e-7) << power;
    }
  // Of 1 / sqrt(s (L - s)) it is pi / L.
  const double both =
      mean_along(piece, [&](const Point& x) { return 1 / std::sqrt(distance(x, piece.from) * distance(x, piece.to)); });
  EXPECT_NEAR(both, std::acos(-1.0) / 0.5, 1e-6);
}

TEST(MeanAlong, ASealedPlaceSealsWhatIsInSeries) {
  const Data sealed([](const Place& place) { return place.x.x() > 0.4 ? 0.0 : 1.0; }, false, true);
  EXPECT_EQ(MeansAlong(sealed, {piece}, Mean::of_reciprocals, 0)[0], 0);
  const double open = MeansAlong(sealed, {piece}, Mean::of_values, 0)[0];
  EXPECT_GT(open, 0.5);
  EXPECT_LT(open, 0.8);
}

}  // namespace
}  // namespace sprekk::fracture_flow
