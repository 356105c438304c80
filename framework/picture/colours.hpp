// Colours that can be told apart, also by the colour-blind.
#pragma once

#include <string>

namespace sprekk {

/// The style of the i-th of several curves: eight colours (Okabe and Ito, 2008, without yellow, with grey), then the
/// same colours dashed.
struct LineStyle {
  std::string colour;  ///< "#0072b2"
  std::string dash;    ///< of SVG; "" for a solid line
};
LineStyle line_style(int i);

/// The colour map viridis, from dark blue (0) over green to yellow (1); its lightness rises evenly.
std::string viridis(double fraction);

}  // namespace sprekk
