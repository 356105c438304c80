// Parts whose places hold less the farther they move, so that their motion may run away.
#pragma once

#include <string>
#include <vector>

#include "framework/assembly/notes.hpp"
#include "framework/field/field.hpp"

namespace sprekk {

/// The values of a part that are free to move in its present discrete state.
struct FreeValues {
  const Field* row = nullptr;     ///< the field whose equations hold them
  const Field* column = nullptr;  ///< the field that they belong to
  std::vector<int> values;        ///< numbers in both fields, ascending
  Vector factors;                 ///< of each: its equation's residual under a unit of force that drives the value
};

/// What has lost strength from the accepted state to the present one.
struct Softened {
  FreeValues values;  ///< those that have lost some, and are free to move
  /// The largest loss of strength over motion of a value that has moved and loses less by now; infinite where one moves
  /// no longer.
  double spent = 0;
};

/// A loss of stability: with the stiffness of everything else condensed to the free values, less what they lose in
/// strength as they move, there is a motion that needs no force.
struct LossOfStability {
  double time = 0;          ///< s
  double stiffness = 0;     ///< its eigenvalue that has become negative, force over motion
  std::vector<int> values;  ///< the free values of the part, as in FreeValues
  Vector motion;            ///< the eigenvector, one entry each
};

/// Capability: a part whose places hold less the farther they move. Where they lose more than what surrounds them takes
/// off, no sequence of equilibria goes on from there: Newton's method finds none, or one that is far away.
class Softening {
 public:
  virtual ~Softening() = default;
  /// The same on all processes.
  virtual Softened softened() const = 0;
  /// At the present values of the fields.
  virtual FreeValues free_values() const = 0;
  /// Where and why motion has run away, for the message that ends a run, at the values at which this has been found.
  virtual std::string tell_loss(const LossOfStability& loss) const = 0;
  /// Notes that the step which is about to be accepted has passed a loss, of which `told` tells.
  virtual void note_passed(const std::string& told, Notes& notes) = 0;
};

}  // namespace sprekk
