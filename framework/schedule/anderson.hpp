// Anderson acceleration of a fixed-point iteration.
#pragma once

#include <deque>

#include "framework/types.hpp"

namespace sprekk {

/// x_{k+1} = G(x_k) combined with up to `depth` earlier iterates so that the linearized residual G(x) − x is least
/// (Anderson 1965; in the form of Walker and Ni 2011). The caller scales x so that its entries are comparable.
class Anderson {
 public:
  explicit Anderson(int depth) : depth_(depth) {}
  /// The next iterate from x and G(x).
  Vector next(const Vector& x, const Vector& image);
  void forget();  ///< drops all earlier iterates

 private:
  int depth_;
  std::deque<Vector> image_differences_, residual_differences_;
  Vector last_image_, last_residual_;
};

}  // namespace sprekk
