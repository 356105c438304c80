// Pore pressure and initial stress in the domain of boundary elements. Each case adds a particular solution to the
// crack in a plate.
#include <algorithm>
#include <cmath>

#include "tests/components/fine_fracture/boundary_element/cases.hpp"
#include "tests/components/fine_fracture/quarter_point/pore_solution.hpp"

namespace sprekk::test {
namespace {

/// The largest error of the factors of the crack of `exact` plus the particular solution, whose traction the walls
/// (along +x) carry.
double error_with(const PoreSolution& pore) {
  const Griffith exact = paper_crack(1e6, 0.7e6, -3e6);
  const FineGeometry geometry = paper_box();
  const FineLoads loads = loads_with(pore, exact, geometry.cracks[0].points);
  double worst = 0;
  for (const bool is_last : {false, true}) {
    const TipFactors found = boundary_factors(geometry, table_1_rock, {0, is_last}, loads, 0.02, 0.01);
    worst = std::max(worst, relative_error(intensities_of(found), exact.K(), "K"));
  }
  return worst;
}

TEST(BoundaryOffsets, LinearPressure) { EXPECT_LT(error_with(linear_pressure(3e6, {2e7, -5e7})), 1e-5); }

TEST(BoundaryOffsets, PressureOfASourceNearTheTip) {
  // Above the right tip. No crack is there, so that the places of the offset are 0.03 and 0.05 m from one another.
  for (const double away : {0.03, 0.06})
    EXPECT_LT(error_with(pressure_of_source(-2e6, {0.055, away})), away < 0.05 ? 1e-2 : 4e-3) << away;
}

TEST(BoundaryOffsets, PressureThatFallsAwayFromTheCrack) {
  // As of a line that fluid leaves: p = p0 (1 − |y|/d); psi = alpha p0/(lambda + 2G) (y^2/2 − |y|^3/(6 d)).
  const double p0 = 3e6, d = 0.5, factor = biot_alpha * p0 / longitudinal_modulus();
  PoreSolution pore;
  pore.pressure = [=](const Point& x) { return p0 * (1 - std::abs(x.y()) / d); };
  pore.displacement = [=](const Point& x) -> Point {
    return {0, factor * (x.y() - x.y() * std::abs(x.y()) / (2 * d))};
  };
  pore.gradient = [=](const Point& x) -> Tensor {
    Tensor g = Tensor::Zero();
    g(1, 1) = factor * (1 - std::abs(x.y()) / d);
    return g;
  };
  EXPECT_LT(error_with(pore), 6e-4);
}

}  // namespace
}  // namespace sprekk::test
