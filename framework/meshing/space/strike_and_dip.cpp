#include "framework/meshing/space/strike_and_dip.hpp"

#include <cmath>

namespace sprekk {

Point StrikeAndDip::along_strike() const { return {std::sin(strike), std::cos(strike), 0}; }

Point StrikeAndDip::up_dip() const {
  return {-std::cos(dip) * std::cos(strike), std::cos(dip) * std::sin(strike), std::sin(dip)};
}

std::vector<Point> rectangle(const Point& center, const StrikeAndDip& plane, double length, double height) {
  const Point one = 0.5 * length * plane.along_strike(), other = 0.5 * height * plane.up_dip();
  return {center - one - other, center + one - other, center + one + other, center - one + other};
}

Ellipse ellipse(const Point& center, const StrikeAndDip& plane, double along_strike, double along_dip) {
  return {center, along_strike * plane.along_strike(), along_dip * plane.up_dip()};
}

}  // namespace sprekk
