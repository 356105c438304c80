// Quantities against time, in units that fit.
#pragma once

#include <string>
#include <vector>

#include "framework/picture/line_plot.hpp"

namespace sprekk {

/// A quantity against time.
struct HistoryCurve {
  std::string name;
  std::vector<double> times, values;  ///< SI
  LineStyle style;
  bool are_points = false;  ///< points that no line joins
};

/// A panel of curves that share the SI unit `unit`; few points are marked. A curve that covers another
/// one is dashed, so that both are seen.
Panel history_panel(const std::string& title, const std::string& unit, const std::vector<HistoryCurve>& curves);

}  // namespace sprekk
