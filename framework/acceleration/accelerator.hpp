// What accelerates a fixed-point iteration x = G(x).
#pragma once

#include <map>
#include <string>

#include "framework/types.hpp"

namespace sprekk {

/// Chooses the next iterate from x and G(x), in each pass of an iteration. The entries of all vectors are comparable
/// with one another: they have been divided by scales that the caller chooses for each run of the iteration.
class Accelerator {
 public:
  virtual ~Accelerator() = default;
  /// An iteration begins. `scale`: what its values have been divided by, one an entry; positive.
  virtual void begin(const Vector& scale) = 0;
  /// The next iterate from x and G(x), both divided by the scale.
  virtual Vector next(const Vector& x, const Vector& image) = 0;
  /// Called between passes where cells begin to stick, slip or open: earlier passes of this iteration tell nothing of
  /// the next ones, which are another piece of a piecewise smooth map.
  virtual void forget() = 0;

  /// Called when the time step has been accepted: what the last iteration has learned may be kept for later ones. What
  /// is kept must not depend on the scale, which changes from one iteration to the next.
  virtual void accepted() {}
  /// Called when the time step is taken back: what iterations since the last acceptance have learned is forgotten.
  virtual void rewound() {}
  /// Called when an iteration has not converged: forgets what was learned in former time steps, and returns whether
  /// there was anything. What was learned in steps of another length, or with walls in other states, may mislead.
  virtual bool forget_steps() { return false; }
  /// For checkpoints: what later time steps use of former ones, as named values. `restore` ignores values of another
  /// shape, and forgets what there was.
  virtual void save(std::map<std::string, Vector>& /*state*/) const {}
  virtual void restore(const std::map<std::string, Vector>& /*state*/) {}
};

}  // namespace sprekk
