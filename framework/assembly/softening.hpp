// Parts that lose strength as they move, so that their motion may become unstable.
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
  Vector factors;                 ///< of each: the residual of its equation per unit of force that drives the value
};

/// What has lost strength from the accepted state to the present one.
struct Softened {
  FreeValues values;  ///< those that have lost some, and are free to move
  /// Over all values that have moved and lose strength more slowly now than at the start of the step: the largest loss
  /// of strength over motion at the start. Infinite if a value that has moved is no longer free to move.
  double spent = 0;
};

/// A loss of stability: the stiffness condensed to the free values, less their loss of strength over motion, has a
/// negative eigenvalue, so that there is a motion that needs no force.
struct LossOfStability {
  double time = 0;          ///< s
  double stiffness = 0;     ///< its eigenvalue that has become negative, force over motion
  std::vector<int> values;  ///< the free values of the part, as in FreeValues
  Vector motion;            ///< the eigenvector, one entry each
};

/// Capability: a part that loses strength as it moves. Where the loss of strength over motion exceeds the stiffness of
/// the surroundings, no sequence of equilibria goes on from there: Newton's method finds none, or one that is far away.
class Softening {
 public:
  virtual ~Softening() = default;
  /// The same on all processes.
  virtual Softened softened() const = 0;
  /// At the present values of the fields.
  virtual FreeValues free_values() const = 0;
  /// Where and why stability was lost, for the message that ends a run; called at the values at which this was found.
  virtual std::string tell_loss(const LossOfStability& loss) const = 0;
  /// Notes that the step which is about to be accepted has passed a loss of stability; `told`: the text of tell_loss.
  virtual void note_passed(const std::string& told, Notes& notes) = 0;
};

}  // namespace sprekk
