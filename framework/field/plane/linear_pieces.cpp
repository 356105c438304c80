#include "framework/field/linear_pieces.hpp"

#include "framework/invariants.hpp"
#include "framework/mesh/plane/planar.hpp"

namespace sprekk {

double LinearPiece::at(const Point& x) const {
  const Point &a = corners[0], &b = corners[1], &c = corners[2];
  const double twice = cross(b - a, c - a);
  SPREKK_EXPECT(twice > 0, twice);
  const double of_a = cross(b - x, c - x) / twice, of_b = cross(c - x, a - x) / twice;
  return of_a * values[0] + of_b * values[1] + (1 - of_a - of_b) * values[2];
}

}  // namespace sprekk
