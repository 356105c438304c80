// Formulas that jump.
#pragma once

#include <optional>

#include "framework/formula/program.hpp"

namespace sprekk::formula {

/// Where a formula jumps.
struct Jump {
  std::size_t variable;
  double at;        ///< the value of the variable behind the jump
  double from, to;  ///< values of the formula
};

/// A jump of the program while one variable from `first` on, of `count` in all, changes; the first that is found. Each
/// is led from 0 through values of all sizes, at a few values of the others.
std::optional<Jump> find_jump(const Program& program, std::size_t first, std::size_t count);

}  // namespace sprekk::formula
