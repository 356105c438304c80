// Stress that is not elastic: pore pressure. Each case adds a particular solution to the crack in a plate.
#include <algorithm>

#include "tests/components/fine_fracture/quarter_point/cases.hpp"

namespace sprekk::test {
namespace {

constexpr double alpha = 0.8;

/// Displacements u = grad(psi) with laplace psi = alpha p / (lambda + 2G) carry the pressure p: div (C eps(u) - alpha p
/// I) = 0.
struct PoreSolution {
  std::function<double(const Point&)> pressure;
  std::function<Point(const Point&)> displacement;
  std::function<Tensor(const Point&)> gradient;
};

double longitudinal() { return table_1_rock.lambda + 2 * table_1_rock.shear; }

/// The crack of `exact` plus the particular solution, whose traction the walls (along +x) carry.
FineSolution solve_with(const PoreSolution& pore, const Griffith& exact, const FineGeometry& geometry) {
  const FineModel model(geometry, paper_mesh(), table_1_rock);
  const auto& path = geometry.cracks[0].points;
  FineLoads loads;
  loads.boundary_displacement = [&](const Point& x, const Point& inside) -> Point {
    return exact.displacement(x, inside) + pore.displacement(x);
  };
  loads.stress_offset = at_each_place(
      [&](const Point& x) -> Eigen::Vector3d { return -alpha * pore.pressure(x) * Eigen::Vector3d(1, 1, 0); });
  loads.wall_traction = [&](int, int segment, double s) -> Point {
    const Point x = path[segment] + s * (path[segment + 1] - path[segment]);
    const Tensor total = table_1_rock.stress(pore.gradient(x)) - alpha * pore.pressure(x) * Tensor::Identity();
    return total * Point(0, -1);
  };
  return model.solve(loads);
}

double error_with(const PoreSolution& pore, const FineGeometry& geometry = paper_box()) {
  const Griffith exact = paper_crack(1e6, 0.7e6, -3e6);
  return worst_error(solve_with(pore, exact, geometry), exact.K());
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

TEST(StressOffset, LinearPressure) {
  // psi = alpha / (lambda + 2G) (p0 r^2 / 4 + r^2 (b . x) / 8)
  const double p0 = 3e6, factor = alpha / longitudinal();
  const Point b(2e7, -5e7);
  PoreSolution pore;
  pore.pressure = [=](const Point& x) { return p0 + b.dot(x); };
  pore.displacement = [=](const Point& x) -> Point {
    return factor * (0.5 * p0 * x + (2 * b.dot(x) * x + x.squaredNorm() * b) / 8);
  };
  pore.gradient = [=](const Point& x) -> Tensor {
    return factor * (0.5 * p0 * Tensor::Identity() +
                     (2 * b.dot(x) * Tensor::Identity() + 2 * x * b.transpose() + 2 * b * x.transpose()) / 8);
  };
  EXPECT_LT(error_with(pore), 5e-4);
}

TEST(StressOffset, PressureOfASourceNearTheTip) {
  // p = c ln r about a place 3 cm above the right tip; psi = alpha c / (lambda + 2G) r^2 (ln r - 1) / 4.
  const double c = -2e6, factor = alpha * c / longitudinal();
  const Point source(0.055, 0.03);
  PoreSolution pore;
  pore.pressure = [=](const Point& x) { return c * std::log((x - source).norm()); };
  pore.displacement = [=](const Point& x) -> Point {
    const Point d = x - source;
    return factor * (0.5 * std::log(d.norm()) - 0.25) * d;
  };
  pore.gradient = [=](const Point& x) -> Tensor {
    const Point d = x - source;
    return factor *
           ((0.5 * std::log(d.norm()) - 0.25) * Tensor::Identity() + 0.5 * d * d.transpose() / d.squaredNorm());
  };
  EXPECT_LT(error_with(pore), 2e-3);
}

TEST(StressOffset, PressureThatJumpsAcrossTheCrackAndAheadOfIt) {
  // p for y > 0 only: u_y = alpha p y / (lambda + 2G) there.
  const double p = 3e6;
  PoreSolution pore;
  pore.pressure = [=](const Point& x) { return x.y() > 0 ? p : 0; };
  pore.displacement = [=](const Point& x) { return Point(0, alpha * p / longitudinal() * std::max(x.y(), 0.0)); };
  pore.gradient = [=](const Point& x) {
    Tensor g = Tensor::Zero();
    if (x.y() > 0) g(1, 1) = alpha * p / longitudinal();
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
  pore.displacement = [=](const Point& x) { return Point(alpha * p / longitudinal() * std::min(x.x() - x0, 0.0), 0); };
  pore.gradient = [=](const Point& x) {
    Tensor g = Tensor::Zero();
    if (x.x() < x0) g(0, 0) = alpha * p / longitudinal();
    return g;
  };
  FineGeometry geometry = paper_box();
  geometry.cracks[0] = {{{-0.05, 0}, {x0, 0}, {0.05, 0}}, true, true, {Walls::traction, Walls::traction}};
  // Elements do not follow the strain's jump in their middle: the worst place for it.
  EXPECT_LT(error_with(pore, geometry), 3e-2);
}

}  // namespace
}  // namespace sprekk::test
