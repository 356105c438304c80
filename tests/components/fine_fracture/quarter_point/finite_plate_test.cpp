// Published stress-intensity factors of plates.
#include "tests/components/fine_fracture/quarter_point/cases.hpp"

namespace sprekk::test {
namespace {

std::vector<Side> tractions() { return std::vector<Side>(4, Side::traction); }

FineLoads tension_along_y(double stress) {
  return {.boundary_traction = [=](const Point&, const Point& n) { return Point(0, n.y() * stress); }};
}

TEST(FinitePlate, CentreCrackInAStrip) {
  // F = sqrt(sec(pi r / 2)) (1 - 0.025 r^2 + 0.06 r^4), r = a / w, is right to 0.1 % (Tada, Paris and Irwin 2000).
  for (const double ratio : {0.2, 0.5, 0.7}) {
    FineGeometry geometry{rectangle(-1, -4, 1, 4), {inner_crack({-ratio, 0}, {ratio, 0})}, tractions()};
    const FineModel model(geometry, {.tip_size = 0.05, .far_size = 0.5}, table_1_rock);
    const FineSolution solution = model.solve(tension_along_y(1e6));
    const double F =
        std::sqrt(1 / std::cos(std::numbers::pi * ratio / 2)) * (1 - 0.025 * ratio * ratio + 0.06 * std::pow(ratio, 4));
    const double K = 1e6 * std::sqrt(std::numbers::pi * ratio) * F;
    EXPECT_LT(worst_error(solution, {K, 0}, "ratio " + std::to_string(ratio)), 2e-3);
    // Correlation with 16 sectors and a small rosette.
    for (const TipIntensities& tip : solution.tips) EXPECT_NEAR(tip.K_extrapolated.x(), K, 1e-2 * K);
  }
}

TEST(FinitePlate, EdgeCrackInAHalfPlane) {
  // K_I = 1.12152 sigma sqrt(pi a) (Koiter 1965). The plate is 200 crack lengths wide.
  FineGeometry geometry{
      rectangle(0, -200, 200, 200), {{{{0, 0}, {1, 0}}, false, true, {Walls::traction}}}, tractions()};
  const FineModel model(geometry, {.tip_size = 0.1, .far_size = 40}, table_1_rock);
  const FineSolution solution = model.solve(tension_along_y(1e6));
  const double K = 1.12152e6 * std::sqrt(std::numbers::pi);
  EXPECT_LT(worst_error(solution, {K, 0}), 1e-3);
  EXPECT_NEAR(solution.tips[0].K_extrapolated.x(), K, 1e-2 * K);
}

TEST(FinitePlate, SlantedCrackInABigPlate) {
  // K_I = sigma sqrt(pi a) cos^2 b, K_II = sigma sqrt(pi a) sin b cos b, b between the crack's normal and the tension.
  for (const double b : {0.3, std::numbers::pi / 4, 1.1}) {
    // A crack along (cos b, sin b) has its normal at the angle b from y.
    const Point end(std::cos(b), std::sin(b));
    FineGeometry geometry{rectangle(-60, -60, 60, 60), {inner_crack(-end, end)}, tractions()};
    const FineModel model(geometry, {.tip_size = 0.1, .far_size = 20}, table_1_rock);
    const FineSolution solution = model.solve(tension_along_y(1e6));
    const double K = 1e6 * std::sqrt(std::numbers::pi);
    const Point exact(K * std::pow(std::cos(b), 2), K * std::sin(b) * std::cos(b));
    EXPECT_LT(worst_error(solution, exact, "slant " + std::to_string(b)), 1e-3);
    for (const TipIntensities& tip : solution.tips)
      EXPECT_LT(relative_error(tip.K_extrapolated, exact, "extrapolated"), 1e-2);
  }
}

TEST(FinitePlate, EdgeCrackUnderEndShear) {
  // Yau, Wang and Corten 1980: width 7, length 16, crack 3.5, shear 1 on the free end: K_I = 34.0, K_II = 4.55.
  const double E = 30e6, nu = 0.25;
  const Elasticity rock{E * nu / ((1 + nu) * (1 - 2 * nu)), E / (2 * (1 + nu))};
  FineGeometry geometry{rectangle(0, -8, 7, 8), {{{{0, 0}, {3.5, 0}}, false, true, {Walls::traction}}}, tractions()};
  geometry.sides[0] = Side::displacement;
  const FineModel model(geometry, {.tip_size = 0.2, .far_size = 1}, rock);
  const FineSolution solution =
      model.solve({.boundary_traction = [](const Point&, const Point& n) { return Point(n.y() > 0.5 ? 1 : 0, 0); }});
  const Point K = solution.tips[0].K;
  RecordProperty("K_I", std::to_string(K.x()));
  RecordProperty("K_II", std::to_string(K.y()));
  // Published from coarse meshes, with three digits; refined, ours converge to 34.04 and 4.537.
  EXPECT_NEAR(K.x(), 34.0, 0.05);
  EXPECT_NEAR(K.y(), 4.55, 0.02);
}

}  // namespace
}  // namespace sprekk::test
