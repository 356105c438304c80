// Straight wings at a closed crack with friction in a plate under uniaxial compression, whose walls slide and part.
#include <Eigen/Geometry>
#include <numbers>

#include "tests/components/fine_fracture/boundary_element/cases.hpp"

namespace sprekk::test {
namespace {

constexpr double friction = 0.3;

/// K_I at both ends of a crack of half-length 1 at 45 degrees with wings along the load, in units of sigma_1 sqrt(pi
/// c).
Point sliding_wings(double length, double turn, bool is_mirrored) {
  constexpr double far = 240;  // what the outline changes goes with (size of the crack / far)^2
  const Tensor placed = turn_by(turn, is_mirrored);
  const Point along = placed * Point(1, 1).normalized(), ahead = placed * Point(length, 0);
  const Point normal = placed * Point(1, -1).normalized();
  CrackPath crack{{-along - ahead, -along, along, along + ahead}, true, true, std::vector<Walls>(3, Walls::traction)};
  const Point plus_to_minus(along.y(), -along.x());
  const Elasticity rock{1, 1.5};
  const Point push = placed.col(0);
  const Tensor strain = rock.strain(Tensor(-push * push.transpose()));
  FineLoads loads;
  loads.boundary_displacement = [&](const Point& x, const Point&) -> Point { return strain * x; };
  // Above the crack the rock slides down along it; friction holds it. In a mirror image the plus wall is the other one.
  const double side = plus_to_minus.dot(normal);
  const TipSurroundings::Sliding law{Point::Zero(), side * (normal + friction * along), plus_to_minus, 0};
  loads.sliding = [&](int, int segment, double) { return segment == 1 ? std::optional(law) : std::nullopt; };
  Point K;
  for (const bool is_last : {false, true})
    K[is_last] = boundary_factors({rectangle(-far, -far, far, far), {crack}}, rock, {0, is_last}, loads, 0.5).sifs.k1 /
                 std::sqrt(std::numbers::pi);
  return K;
}

TEST(BoundaryWings, DryWingsHaveThePublishedFactors) {
  for (const auto& [length, K] : {std::pair{0.01, 0.30466}, std::pair{0.1, 0.24689}, std::pair{0.3, 0.20148},
                                  std::pair{1.0, 0.13885}, std::pair{3.0, 0.08509}})
    for (const auto& [turn, is_mirrored] : {std::pair{0.0, false}, std::pair{0.7, false}, std::pair{0.2, true}}) {
      const Point found = sliding_wings(length, turn, is_mirrored);
      RecordProperty("K_I at " + std::to_string(length), std::to_string(found[1]));
      EXPECT_NEAR(found[0], K, 1e-3 * K) << length << " turned by " << turn;
      EXPECT_NEAR(found[1], K, 1e-3 * K) << length << " turned by " << turn;
    }
}

}  // namespace
}  // namespace sprekk::test
