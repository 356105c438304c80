// Integration rules on the unit triangle and on the unit interval.
#pragma once

#include <vector>

namespace sprekk::fine_fracture {

/// A point of a rule on the unit triangle.
struct TrianglePoint {
  double xi, eta, weight;  ///< weights sum up to 1/2
};
/// A point of a rule on the interval from 0 to 1.
struct LinePoint {
  double t, weight;  ///< weights sum up to 1
};

/// Gauss-Legendre with n points.
const std::vector<LinePoint>& line_rule(int n);

/// Symmetric rules for polynomials of degree 2, 4, 5 and 6 (3, 6, 7, 12 points; Dunavant 1985).
/// Throws std::invalid_argument for other degrees.
const std::vector<TrianglePoint>& triangle_rule(int degree);

/// A product of Gauss rules in the polar coordinates of corner 0: along rays, and across them. In a quarter-point
/// element, where distance from the tip is the square of the first coordinate, integrands with r^-1, r^-1/2 become
/// polynomials; 2 x 3 points integrate its stiffness exactly.
const std::vector<TrianglePoint>& polar_rule(int along, int across);

}  // namespace sprekk::fine_fracture
