// Parts whose equations are nonlinear even while their discrete state stays the same.
#pragma once

namespace sprekk {

/// A part whose coefficients (Part::hold_coefficients) may keep Newton's method from converging although no discrete
/// state changes. Newton's method then takes its last attempts, in which coefficients are held and then released step
/// by step, also where no state has changed.
class NonlinearInPieces {
 public:
  virtual ~NonlinearInPieces() = default;
  virtual bool is_nonlinear_in_pieces() const = 0;
};

}  // namespace sprekk
