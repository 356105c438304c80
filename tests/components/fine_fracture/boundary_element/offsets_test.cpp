// Pore pressure and initial stress in the domain of boundary elements. Each case adds a particular solution to the
// crack in a plate.
#include <algorithm>

#include "tests/components/fine_fracture/boundary_element/cases.hpp"

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

/// The largest error of the factors of the crack of `exact` plus the particular solution, whose traction the walls
/// (along +x) carry.
double error_with(const PoreSolution& pore) {
  const Griffith exact = paper_crack(1e6, 0.7e6, -3e6);
  const FineGeometry geometry = paper_box();
  FineLoads loads;
  loads.boundary_displacement = [&](const Point& x, const Point& inside) -> Point {
    return exact.displacement(x, inside) + pore.displacement(x);
  };
  loads.stress_offset = at_each_place(
      [&](const Point& x) -> Eigen::Vector3d { return -alpha * pore.pressure(x) * Eigen::Vector3d(1, 1, 0); });
  loads.wall_traction = [&](int, int, double s) -> Point {
    const Point x(-0.05 + 0.1 * s, 0);
    const Tensor total = table_1_rock.stress(pore.gradient(x)) - alpha * pore.pressure(x) * Tensor::Identity();
    return total * Point(0, -1);
  };
  double worst = 0;
  for (const bool is_last : {false, true}) {
    const TipFactors found = boundary_factors(geometry, table_1_rock, {0, is_last}, loads, 0.02, 0.01);
    worst = std::max(worst, relative_error(intensities_of(found), exact.K(), "K"));
  }
  return worst;
}

TEST(BoundaryOffsets, LinearPressure) {
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
  EXPECT_LT(error_with(pore), 1e-5);
}

TEST(BoundaryOffsets, PressureOfASourceNearTheTip) {
  // p = c ln r about a place above the right tip; psi = alpha c / (lambda + 2G) r^2 (ln r - 1) / 4.
  for (const double away : {0.03, 0.06}) {
    const double c = -2e6, factor = alpha * c / longitudinal();
    const Point source(0.055, away);
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
    // No crack is there, so that the places of the offset are 0.03 and 0.05 m from one another.
    EXPECT_LT(error_with(pore), away < 0.05 ? 1e-2 : 4e-3) << away;
  }
}

TEST(BoundaryOffsets, PressureThatFallsAwayFromTheCrack) {
  // As of a line that fluid leaves: p = p0 (1 − |y|/d); psi = alpha p0/(lambda + 2G) (y^2/2 − |y|^3/(6 d)).
  const double p0 = 3e6, d = 0.5, factor = alpha * p0 / longitudinal();
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
