// A pore pressure that loads the rock, whatever discretizes the stress.
#pragma once

#include "framework/field/field.hpp"

namespace sprekk::poromechanics {

/// A pressure p, Pa, that adds -alpha (p - p_0) I to the stress. One value a cell each.
struct PoreLoad {
  const Field* pressure;
  Vector alpha;       ///< Biot coefficients; zero in cells that are taken away
  Vector reference;   ///< p_0, Pa
  Vector given = {};  ///< Biot coefficients of all cells

  /// alpha (p - p_0) with the present pressure, Pa.
  Vector stress() const { return alpha.cwiseProduct(pressure->now() - reference); }
};

}  // namespace sprekk::poromechanics
