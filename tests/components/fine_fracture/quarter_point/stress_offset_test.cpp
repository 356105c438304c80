// Stress that is not elastic: pore pressure. Each case adds a particular solution to the crack in a plate.
#include <algorithm>

#include "tests/components/fine_fracture/quarter_point/pore_solution.hpp"

namespace sprekk::test {
namespace {

double error_with(const PoreSolution& pore, const FineGeometry& geometry = paper_box()) {
  const Griffith exact = paper_crack(1e6, 0.7e6, -3e6);
  const FineModel model(geometry, paper_mesh(), table_1_rock);
  return worst_error(model.solve(loads_with(pore, exact, geometry.cracks[0].points)), exact.K());
}

TEST(StressOffset, UniformOffsetIsATractionOnTheOutline) {
  // Free outline and walls under the offset s: the rock strains by -C^-1 s and there is no stress at all.
  FineGeometry geometry = paper_box();
  geometry.sides.assign(4, Side::traction);
  const FineModel model(geometry, paper_mesh(), table_1_rock);
  const FineSolution solution =
      model.solve({.stress_offset = at_each_place([](const Point&) { return Eigen::Vector3d(-4e6, -1e6, 2e6); })});
  for (const TipIntensities& tip : solution.tips) {
    EXPECT_LT(tip.K.norm(), 1e-9 * 4e6);
    EXPECT_NEAR(tip.T, 0, 1e-8 * 4e6);
  }
}

TEST(StressOffset, LinearPressure) { EXPECT_LT(error_with(linear_pressure(3e6, {2e7, -5e7})), 5e-4); }

TEST(StressOffset, PressureOfASourceNearTheTip) {
  // 3 cm above the right tip
  EXPECT_LT(error_with(pressure_of_source(-2e6, {0.055, 0.03})), 2e-3);
}

TEST(StressOffset, PressureThatJumpsAcrossTheCrackAndAheadOfIt) {
  // p for y > 0 only: u_y = alpha p y / (lambda + 2G) there.
  const double p = 3e6;
  PoreSolution pore;
  pore.pressure = [=](const Point& x) { return x.y() > 0 ? p : 0; };
  pore.displacement = [=](const Point& x) {
    return Point(0, biot_alpha * p / longitudinal_modulus() * std::max(x.y(), 0.0));
  };
  pore.gradient = [=](const Point& x) {
    Tensor g = Tensor::Zero();
    if (x.y() > 0) g(1, 1) = biot_alpha * p / longitudinal_modulus();
    return g;
  };
  // The walls are free: sigma_yy vanishes on both sides. Elements ahead of the tip that the jump crosses blur it.
  EXPECT_LT(error_with(pore), 5e-3);
}

TEST(StressOffset, PressureThatJumpsAcrossTheRosette) {
  // p for x < x0 = 45 mm only, half-way through the rosette, where the path has a point;
  // the walls carry sigma_yy = -2G alpha p / (lambda + 2G)
  // there.
  const double p = 3e6, x0 = 0.045;
  PoreSolution pore;
  pore.pressure = [=](const Point& x) { return x.x() < x0 ? p : 0; };
  pore.displacement = [=](const Point& x) {
    return Point(biot_alpha * p / longitudinal_modulus() * std::min(x.x() - x0, 0.0), 0);
  };
  pore.gradient = [=](const Point& x) {
    Tensor g = Tensor::Zero();
    if (x.x() < x0) g(0, 0) = biot_alpha * p / longitudinal_modulus();
    return g;
  };
  FineGeometry geometry = paper_box();
  geometry.cracks[0] = {{{-0.05, 0}, {x0, 0}, {0.05, 0}}, true, true, {Walls::traction, Walls::traction}};
  // Elements do not follow the strain's jump in their middle: the worst place for it.
  EXPECT_LT(error_with(pore, geometry), 3e-2);
}

}  // namespace
}  // namespace sprekk::test
