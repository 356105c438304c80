#include "framework/picture/history_panel.hpp"

#include <algorithm>
#include <cmath>

#include "framework/picture/display_unit.hpp"

namespace sprekk {
namespace {

constexpr std::size_t marked_up_to = 40;  // points

void include(const std::vector<double>& values, double& largest) {
  for (const double value : values)
    if (std::isfinite(value)) largest = std::max(largest, std::abs(value));
}

std::vector<double> divided(std::vector<double> values, double scale) {
  for (double& value : values) value /= scale;
  return values;
}

}  // namespace

Panel history_panel(const std::string& title, const std::string& unit, const std::vector<HistoryCurve>& curves) {
  double latest = 0, largest = 0;
  for (const HistoryCurve& curve : curves) {
    include(curve.times, latest);
    include(curve.values, largest);
  }
  const DisplayUnit time_unit = display_unit("s", latest), value_unit = display_unit(unit, largest);
  Panel panel;
  panel.title = title;
  panel.x_label = "time [" + time_unit.text + "]";
  panel.y_label = value_unit.text;
  for (const HistoryCurve& curve : curves)
    panel.curves.push_back({curve.name, divided(curve.times, time_unit.scale), divided(curve.values, value_unit.scale),
                            curve.style, curve.times.size() <= marked_up_to});
  return panel;
}

}  // namespace sprekk
