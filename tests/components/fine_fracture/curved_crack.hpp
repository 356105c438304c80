// The slightly curved crack of Cotterell and Rice (Int. J. Fracture 16 (1980) 155), to first order in its slope.
#pragma once

#include <algorithm>
#include <cmath>
#include <numbers>
#include <vector>

#include "components/fine_fracture/growth/grow_tips.hpp"

namespace sprekk::fine_fracture {

/// A traction-free crack around the origin, straight from −half_length to half_length along x, that has grown in the
/// same way (turned by 180 degrees) at both ends. Far away sigma_yy = opening, sigma_xx = opening + t_stress. With both
/// tips on the chord, omega the slope of the chord:
///   K_I = opening sqrt(pi a),
///   K_II = (y'(a) − omega) K_I/2 − t_stress/sqrt(pi a) Int_{−a}^{a} y'(x) sqrt((a + x)/(a − x)) dx.
struct CurvedCrack {
  double half_length, opening, t_stress;

  Sifs sifs(const std::vector<Point>& added) const {
    double x = half_length, slope = 0;
    Point from(half_length, 0);
    struct Piece {
      double begin, end, slope;
    };
    std::vector<Piece> pieces;
    for (const Point& to : added) {
      slope = std::atan2(to[1] - from[1], to[0] - from[0]);
      const double length = (to - from).norm();
      pieces.push_back({x, x + length, slope});
      pieces.push_back({-x - length, -x, slope});
      x += length;
      from = to;
    }
    const double a = x;
    const auto primitive = [a](double t) {
      return a * std::asin(std::clamp(t / a, -1.0, 1.0)) - std::sqrt(std::max(0.0, a * a - t * t));
    };
    double weighted = 0, rise = 0;
    for (const Piece& piece : pieces) {
      weighted += piece.slope * (primitive(piece.end) - primitive(piece.begin));
      rise += piece.slope * (piece.end - piece.begin);
    }
    const double root = std::sqrt(std::numbers::pi * a), k1 = opening * root;
    return {k1, (slope - rise / (2 * a)) * k1 / 2 - t_stress / root * weighted, t_stress};
  }
};

}  // namespace sprekk::fine_fracture
