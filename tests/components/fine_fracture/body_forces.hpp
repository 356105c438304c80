// Body forces with closed forms, for the tests of fine levels.
#pragma once

#include <Eigen/LU>
#include <algorithm>
#include <cmath>
#include <functional>
#include <vector>

#include "tests/components/fine_fracture/quarter_point/cases.hpp"

namespace sprekk::test {

/// The force b = f beta(m·x) in plane layers with the normal m: u = −h(m·x) A^-1 f with h'' = beta, and
/// A = G I + (lambda + G) m m^T, carries it. beta is 1, behind a border also 1 + more.
struct LayeredForce {
  Point force;      ///< f, N/m^3
  double angle;     ///< rad, of m to the x axis
  double more = 0;  ///< where m·x > border
  double border = 0;
  Elasticity rock = table_1_rock;

  Point normal() const { return {std::cos(angle), std::sin(angle)}; }
  double behind(const Point& x) const { return std::max(0.0, normal().dot(x) - border); }

  Point at(const Point& x) const { return (1 + (behind(x) > 0 ? more : 0)) * force; }
  Point direction() const {
    const Tensor acoustic =
        rock.shear * Tensor::Identity() + (rock.lambda + rock.shear) * normal() * normal().transpose();
    return -(acoustic.inverse() * force);
  }
  Point displacement(const Point& x) const {
    const double z = normal().dot(x);
    return 0.5 * (z * z + more * behind(x) * behind(x)) * direction();
  }
  Tensor stress(const Point& x) const {
    return rock.stress((normal().dot(x) + more * behind(x)) * direction() * normal().transpose());
  }

  /// The loads on the crack of `exact` in its plate, and beside them this force.
  FineLoads loads(const Griffith& exact, const FineGeometry& geometry) const {
    FineLoads loads;
    loads.boundary_displacement = [*this, exact](const Point& x, const Point& inside) -> Point {
      return exact.displacement(x, inside) + displacement(x);
    };
    loads.body_force = [*this](const std::vector<Point>& places) {
      Eigen::Matrix2Xd forces(2, places.size());
      for (std::size_t i = 0; i < places.size(); ++i) forces.col(i) = at(places[i]);
      return forces;
    };
    const Point from = geometry.cracks[0].points.front(), to = geometry.cracks[0].points.back();
    loads.wall_traction = [*this, from, to](int, int, double s) -> Point {
      return stress(from + s * (to - from)) * Point(0, -1);
    };
    return loads;
  }
  double T(const Griffith& exact, const Point& tip) const {
    const Tensor more_at_tip = stress(tip);
    return exact.T() + more_at_tip(0, 0) - more_at_tip(1, 1);
  }
};

/// One force everywhere, in eight directions; it changes the stress over the box by as much as the plate has.
inline std::vector<LayeredForce> uniform_forces() {
  std::vector<LayeredForce> forces;
  for (int k = 0; k < 8; ++k) {
    const double angle = 0.3 + k * std::numbers::pi / 4;
    forces.push_back({.force = 4e6 * Point(std::cos(angle), std::sin(angle)), .angle = 0.4 * k});
  }
  return forces;
}

/// Rock that is twice as heavy behind a border: above and below the crack, ahead of a tip, inclined, through the crack,
/// and with the force along the border, across it and inclined to it.
inline std::vector<LayeredForce> layered_forces() {
  constexpr double right_angle = std::numbers::pi / 2;
  std::vector<LayeredForce> forces;
  for (const auto& [angle, border] :
       {std::pair(right_angle, 0.03), std::pair(-right_angle, 0.03), std::pair(0.0, 0.075), std::pair(0.8, 0.06),
        std::pair(0.0, 0.01), std::pair(right_angle, 0.0)})
    for (const double turned : {0.0, 1.0, right_angle})
      forces.push_back({.force = 4e6 * Point(std::cos(angle + turned), std::sin(angle + turned)),
                        .angle = angle,
                        .more = 1,
                        .border = border});
  return forces;
}

}  // namespace sprekk::test
