// Parts whose equations are nonlinear while the discrete state stays.
#pragma once

namespace sprekk {

/// A part whose coefficients (Part::hold_coefficients) may keep Newton's method from converging although no discrete
/// state changes. Newton's method then takes its last attempts, with held coefficients that are released step by step,
/// also where states stay.
class NonlinearInPieces {
 public:
  virtual ~NonlinearInPieces() = default;
  virtual bool is_nonlinear_in_pieces() const = 0;
};

}  // namespace sprekk
