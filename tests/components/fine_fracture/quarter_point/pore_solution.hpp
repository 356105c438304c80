// Pore pressures in a plate with displacements in closed form, to be added to a crack in the plate.
#pragma once

#include <cmath>
#include <functional>
#include <vector>

#include "tests/components/fine_fracture/quarter_point/cases.hpp"

namespace sprekk::test {

inline constexpr double biot_alpha = 0.8;

/// Displacements u = grad(psi) with laplace psi = alpha p / (lambda + 2G) carry the pressure p: div (C eps(u) - alpha p
/// I) = 0.
struct PoreSolution {
  std::function<double(const Point&)> pressure;
  std::function<Point(const Point&)> displacement;
  std::function<Tensor(const Point&)> gradient;
};

inline double longitudinal_modulus() { return table_1_rock.lambda + 2 * table_1_rock.shear; }

/// p = p0 + b . x: psi = alpha / (lambda + 2G) (p0 r^2 / 4 + r^2 (b . x) / 8).
inline PoreSolution linear_pressure(double p0, const Point& b) {
  const double factor = biot_alpha / longitudinal_modulus();
  PoreSolution pore;
  pore.pressure = [=](const Point& x) { return p0 + b.dot(x); };
  pore.displacement = [=](const Point& x) -> Point {
    return factor * (0.5 * p0 * x + (2 * b.dot(x) * x + x.squaredNorm() * b) / 8);
  };
  pore.gradient = [=](const Point& x) -> Tensor {
    return factor * (0.5 * p0 * Tensor::Identity() +
                     (2 * b.dot(x) * Tensor::Identity() + 2 * x * b.transpose() + 2 * b * x.transpose()) / 8);
  };
  return pore;
}

/// p = c ln r about a place: psi = alpha c / (lambda + 2G) r^2 (ln r - 1) / 4.
inline PoreSolution pressure_of_source(double c, const Point& source) {
  const double factor = biot_alpha * c / longitudinal_modulus();
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
  return pore;
}

/// Loads of the crack of `exact` plus the particular solution, whose traction the walls carry: the path is along +x.
inline FineLoads loads_with(const PoreSolution& pore, const Griffith& exact, const std::vector<Point>& path) {
  FineLoads loads;
  loads.boundary_displacement = [=](const Point& x, const Point& inside) -> Point {
    return exact.displacement(x, inside) + pore.displacement(x);
  };
  loads.stress_offset = at_each_place(
      [=](const Point& x) -> Eigen::Vector3d { return -biot_alpha * pore.pressure(x) * Eigen::Vector3d(1, 1, 0); });
  loads.wall_traction = [=](int, int segment, double s) -> Point {
    const Point x = path[segment] + s * (path[segment + 1] - path[segment]);
    const Tensor total = table_1_rock.stress(pore.gradient(x)) - biot_alpha * pore.pressure(x) * Tensor::Identity();
    return total * Point(0, -1);
  };
  return loads;
}

}  // namespace sprekk::test
