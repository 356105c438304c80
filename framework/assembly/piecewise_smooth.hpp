// Parts whose equations are smooth in pieces.
#pragma once

#include <cstdint>
#include <vector>

#include "framework/field/field.hpp"

namespace sprekk {

/// How the parts support an attempt of Newton's method. `with_shortcuts`: the first attempt, with all shortcuts that
/// make most steps quick. `without_shortcuts`: an attempt after a failure. `piecewise`: the discrete state
/// distinguishes all pieces of piecewise linear terms, and derivatives are those of the piece in which the values are,
/// not of the piece in which the update is expected. `piecewise_linear`: the same, and coefficients that make terms
/// nonlinear within a piece keep the values that they have at the moment of the call.
enum class SearchMode { with_shortcuts, without_shortcuts, piecewise, piecewise_linear };

/// Capability: a part whose equations are smooth in pieces only (walls that stick, slip, are open), or have
/// coefficients that Newton's method may have to hold. A part overrides what it has.
class PiecewiseSmooth {
 public:
  virtual ~PiecewiseSmooth() = default;

  /// Changes whenever the discrete state (which cells stick, slip, are open) does; the cycle detector reads it.
  virtual std::uint64_t discrete_state() const { return 0; }
  /// Called before a solve assembles its next iterate; `unknowns`: those of the solve. All that depends on the order of
  /// iterates is changed here, so that Part::assemble gives an iterate the same terms however often it is called.
  virtual void observe_iterate(const std::vector<Field*>& /*unknowns*/) {}
  /// Sets how the part supports Newton's method from now on.
  virtual void set_search_mode(SearchMode) {}

  /// Whether coefficients may keep Newton's method from converging although no discrete state changes. It then takes
  /// its last attempts, in which coefficients are held and then released step by step, also where no state has changed.
  virtual bool is_nonlinear_in_pieces() const { return false; }
  /// With a share of 0 the coefficients that make terms nonlinear within a piece are held at their values now, c_0.
  /// With a larger one they are c_0^(1 − share) c^share with the current value c, and with 1 they are no longer held.
  virtual void release_coefficients(double /*share*/) {}

  /// Moves the fields to where one-sided conditions (contact) are inactive, so that the unknowns that these conditions
  /// hold are free.
  virtual void deactivate_conditions() {}
  /// Finds cells that have left their discrete state in this step by a jump although they could have stayed, and keeps
  /// them in that state from now on, whatever their conditions are. Returns their number.
  virtual int keep_states() { return 0; }
  /// Releases kept cells whose conditions are violated at the present values, and returns their number.
  virtual int release_violated() { return 0; }
  /// Releases all kept cells.
  virtual void release_kept() {}
};

}  // namespace sprekk
