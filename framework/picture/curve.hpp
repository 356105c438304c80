// A curve of a line plot.
#pragma once

#include <string>
#include <vector>

#include "framework/picture/colours.hpp"

namespace sprekk {

/// A curve of a plot.
struct Curve {
  std::string name;          ///< in the legend; "" for none
  std::vector<double> x, y;  ///< of the same length; a number that is not finite interrupts the line
  LineStyle style;
  bool marked = false;  ///< with a dot at each point
};

}  // namespace sprekk
