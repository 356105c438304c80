// Loads on the walls: pressure, shear, and prescribed jumps.
#include "tests/components/fine_fracture/quarter_point/cases.hpp"

namespace sprekk::test {
namespace {

/// On a path along +x the normal from plus to minus is -y: sigma n = (-xy, -yy).
Point traction_of(double yy, double xy) { return {-xy, -yy}; }

TEST(WallLoads, PressurizedWallsInABigRockAtRest) {
  // The far field is zero, its influence on K about (a / box)^2.
  Griffith exact = paper_crack(5e6, 0);
  exact.on_walls = true;
  const FineModel model(paper_box(), paper_mesh(), table_1_rock);
  FineLoads loads = exact_outline(exact);
  loads.wall_traction = [](int, int, double) { return traction_of(-5e6, 0); };
  const FineSolution solution = model.solve(loads);
  EXPECT_LT(worst_error(solution, exact.K()), 5e-4);
  for (const TipIntensities& tip : solution.tips) {
    // Walls under pressure p have sigma_11 = sigma_22 = -p at the tip: T is 0.
    EXPECT_NEAR(tip.T, 0, 1e-3 * 5e6);
  }
}

TEST(WallLoads, ClosedSlidingWallsGiveShearAlone) {
  // Far stress tau; the walls still carry the friction f and the pressure N. They stay closed: K_II = (tau - f) sqrt(pi
  // a).
  const double tau = 5e6, friction = 3e6, N = 15e6;
  const Griffith drop = paper_crack(0, tau - friction);
  FineLoads loads;
  const Elasticity rock = table_1_rock;
  Tensor uniform;
  uniform << -12e6, friction, friction, -N;
  const Tensor strain = rock.strain(uniform);
  loads.boundary_displacement = [=](const Point& x, const Point& inside) -> Point {
    return drop.displacement(x, inside) + strain * x;
  };
  loads.wall_traction = [=](int, int, double) { return traction_of(-N, friction); };
  const FineSolution solution = FineModel(paper_box(), paper_mesh(), rock).solve(loads);
  EXPECT_LT(worst_error(solution, drop.K()), 5e-4);
  for (const TipIntensities& tip : solution.tips) EXPECT_NEAR(tip.T, -12e6 + N, 3e-3 * N);
}

TEST(WallLoads, PressureThatVariesAlongTheWalls) {
  // sigma_yy = -p (1 + x/a) / 2 on the walls: K_I(+-a) = p sqrt(pi a) (1/2 +- 1/4) (weight functions).
  Griffith half = paper_crack(1e6, 0);
  half.on_walls = true;
  // Far from a crack the linear part is a quadrupole that decays as r^-3; the domain is made large instead.
  const double a = half.a, p = 2e6, far = 60 * a;
  FineGeometry geometry = paper_box();
  geometry.outline = rectangle(-far, -far, far, far);
  FineLoads loads = exact_outline(half);
  loads.wall_traction = [=](int, int, double s) { return traction_of(-p * s, 0); };  // s = (1 + x/a) / 2
  const FineSolution solution = FineModel(geometry, {.tip_size = 0.02, .far_size = 1}, table_1_rock).solve(loads);
  const double unit = p * std::sqrt(std::numbers::pi * a);
  EXPECT_LT(relative_error(solution.tips[0].K, {0.25 * unit, 0}, "left"), 1e-3);
  EXPECT_LT(relative_error(solution.tips[1].K, {0.75 * unit, 0}, "right"), 1e-3);
}

TEST(WallLoads, PrescribedJumpsGiveTheIntensitiesOfTheirCrack) {
  const Griffith exact = paper_crack(1e6, 0.7e6, -3e6);
  FineLoads loads = exact_outline(exact);
  loads.wall_jump = [&](int, int, double s) { return exact.jump(exact.a * (2 * s - 1)); };
  // Where displacements are prescribed up to the tip, nothing cancels the error of the rosette's angular resolution.
  constexpr double radius = 0.01;
  for (const auto& [sectors, tolerance] : {std::pair{16, 1e-2}, std::pair{32, 5e-3}, std::pair{64, 2e-3}}) {
    const FineModel model(paper_box(Walls::jump), {.tip_size = radius, .far_size = 0.1, .sectors = sectors},
                          table_1_rock);
    const FineSolution solution = model.solve(loads);
    EXPECT_LT(worst_error(solution, exact.K()), 1e-3);
    for (const TipIntensities& tip : solution.tips) {
      EXPECT_LT(relative_error(tip.K_interaction, exact.K(), std::to_string(sectors) + " sectors"), tolerance);
      EXPECT_NEAR(tip.T, exact.T(), 3e-2 * std::abs(exact.T()));
      // Correlation reads the jumps that were prescribed, sqrt(r (2a - r)); what extrapolation leaves of it is known.
      const double quarter = std::sqrt(1 - radius / exact.a / 8), whole = std::sqrt(1 - radius / exact.a / 2);
      EXPECT_LT(relative_error(tip.K_extrapolated, exact.K() * (4 * quarter - whole) / 3, "extrapolated"), 1e-12);
    }
  }
}

TEST(WallLoads, WallsHeldTogetherUpToTheTipHaveNoIntensity) {
  // Free walls end 2 cm before the tip: there the stress is singular, but not at the tip.
  FineGeometry geometry = paper_box();
  geometry.cracks[0] = {{{-0.05, 0}, {0.03, 0}, {0.05, 0}}, true, true, {Walls::traction, Walls::jump}};
  const FineSolution solution =
      FineModel(geometry, paper_mesh(), table_1_rock).solve(exact_outline(paper_crack(1e6, 0.7e6)));
  EXPECT_LT(solution.tips[1].K.norm(), 1e-9 * solution.tips[0].K.norm());
  // The other tip is that of a crack of 8 cm; the outline's displacements are of one of 10 cm.
  EXPECT_NEAR(solution.tips[0].K.x(), 1e6 * std::sqrt(std::numbers::pi * 0.04),
              0.02 * 1e6 * std::sqrt(0.04 * std::numbers::pi));
}

TEST(WallLoads, JumpsBesideFreeWalls) {
  // The middle of the crack has the exact jump, the ends are free.
  const Griffith exact = paper_crack(1e6, 0.7e6);
  FineGeometry geometry = paper_box();
  geometry.cracks[0] = {
      {{-0.05, 0}, {-0.02, 0}, {0.02, 0}, {0.05, 0}}, true, true, {Walls::traction, Walls::jump, Walls::traction}};
  FineLoads loads = exact_outline(exact);
  loads.wall_jump = [&](int, int, double s) { return exact.jump(0.04 * (s - 0.5)); };
  const FineSolution solution = FineModel(geometry, paper_mesh(), table_1_rock).solve(loads);
  EXPECT_LT(worst_error(solution, exact.K()), 1e-3);
}

TEST(WallLoads, SolvesAreIndependentAndRepeatable) {
  const FineModel model(paper_box(), paper_mesh(), table_1_rock);
  const FineLoads first = exact_outline(paper_crack(1e6, 0)), second = exact_outline(paper_crack(0, 1e6));
  const FineSolution once = model.solve(first), other = model.solve(second), again = model.solve(first);
  EXPECT_EQ(once.displacement, again.displacement);
  EXPECT_NE(once.displacement, other.displacement);
  EXPECT_EQ(once.tips[1].K, again.tips[1].K);
}

}  // namespace
}  // namespace sprekk::test
