#include "framework/picture/history_panel.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "framework/picture/display_unit.hpp"

namespace sprekk {
namespace {

constexpr std::size_t marked_up_to = 40;  // points
constexpr double same = 0.01;             // of the range of all values: a difference that hides one curve below another

void include(const std::vector<double>& values, double& largest) {
  for (const double value : values)
    if (std::isfinite(value)) largest = std::max(largest, std::abs(value));
}

std::vector<double> divided(std::vector<double> values, double scale) {
  for (double& value : values) value /= scale;
  return values;
}

/// Interrupts the line behind each point.
void part(Curve& curve) {
  for (std::size_t i = curve.x.size(); i > 0; --i) {
    const auto behind = static_cast<std::ptrdiff_t>(i);
    curve.x.insert(curve.x.begin() + behind, curve.x[i - 1]);
    curve.y.insert(curve.y.begin() + behind, std::numeric_limits<double>::quiet_NaN());
  }
}

/// Whether both curves have the same values for more than half of the time steps.
bool hides(const Curve& upper, const Curve& lower, double range) {
  if (upper.x != lower.x) return false;
  std::size_t count = 0;
  for (std::size_t i = 0; i < upper.y.size(); ++i)
    if (std::abs(upper.y[i] - lower.y[i]) <= same * range) ++count;
  return 2 * count > upper.y.size();
}

/// Curves that hide others get gaps, in which the others show.
void show_hidden(std::vector<Curve>& curves) {
  double low = std::numeric_limits<double>::infinity(), high = -low;
  for (const Curve& curve : curves)
    for (const double value : curve.y)
      if (std::isfinite(value)) low = std::min(low, value), high = std::max(high, value);
  for (std::size_t i = 1; i < curves.size(); ++i) {
    const auto below =
        std::count_if(curves.begin(), curves.begin() + static_cast<std::ptrdiff_t>(i),
                      [&](const Curve& lower) { return hides(curves[i], lower, std::max(high - low, 0.0)); });
    if (below > 0 && curves[i].style.dash.empty()) curves[i].style.dash = below == 1 ? "7 7" : "3 6";
  }
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
  for (const HistoryCurve& curve : curves) {
    panel.curves.push_back({curve.name, divided(curve.times, time_unit.scale), divided(curve.values, value_unit.scale),
                            curve.style, curve.are_points || curve.times.size() <= marked_up_to});
    if (curve.are_points) part(panel.curves.back());
  }
  show_hidden(panel.curves);
  return panel;
}

}  // namespace sprekk
