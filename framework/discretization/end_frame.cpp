#include "framework/discretization/end_frame.hpp"

#include <cmath>
#include <numbers>

#include "framework/invariants.hpp"

namespace sprekk {

EndFrame::Polar EndFrame::polar(const Point& x, int side, const Tensor& axes) const {
  SPREKK_EXPECT(side >= -1 && side <= 1, side);
  const Eigen::Vector2d local = (axes.transpose() * (x - origin_)).head<2>();
  const double angle = std::atan2(local.y(), local.x());
  // Behind the end a fracture with a bend is beside the line through the end, so `side` decides the sign there.
  const bool is_beyond = angle * side < 0 && local.x() < 0;
  return {local.norm(), is_beyond ? angle + 2 * std::numbers::pi * side : angle};
}

}  // namespace sprekk
