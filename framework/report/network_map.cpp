#include "framework/report/network_map.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>

namespace sprekk {
namespace {

constexpr int most_classes = 8;          // of colours that the eye tells apart
constexpr double lightest = 0.88;        // of the colour map: yellow beyond cannot be seen on white
constexpr const char* grey = "#bbbbbb";  // of no value
constexpr double no_line = std::numeric_limits<double>::quiet_NaN();

/// Classes with as many cells each: a few extreme cells would leave all others one colour in classes of equal width.
class Classes {
 public:
  explicit Classes(std::vector<double> values) {
    std::erase_if(values, [](double value) { return !std::isfinite(value); });
    std::ranges::sort(values);
    if (values.empty()) return;
    for (int k = 0; k < most_classes; ++k)
      bounds_.push_back(values[static_cast<std::size_t>(k) * values.size() / most_classes]);
    bounds_.push_back(values.back());
    bounds_.erase(std::ranges::unique(bounds_).begin(), bounds_.end());
  }
  int count() const { return bounds_.size() == 1 ? 1 : std::max(0, static_cast<int>(bounds_.size()) - 1); }
  int of(double value) const {
    const auto above = std::ranges::upper_bound(bounds_, value);
    return std::clamp(static_cast<int>(above - bounds_.begin()) - 1, 0, count() - 1);
  }
  std::string name(int k, double scale) const {
    const std::string from = fmt::format("{:.3g}", bounds_[static_cast<std::size_t>(k)] / scale);
    if (bounds_.size() == 1) return from;
    return fmt::format("{} to {:.3g}", from, bounds_[static_cast<std::size_t>(k) + 1] / scale);
  }
  std::string colour(int k) const { return viridis(count() == 1 ? 0 : lightest * k / (count() - 1)); }

 private:
  std::vector<double> bounds_;
};

/// Adds the way of a cell, which goes on where the last one has ended.
void add_way(Curve& curve, const std::array<double, 2>& from, const std::array<double, 2>& to, double scale) {
  const double x = from[0] / scale, y = from[1] / scale;
  if (curve.x.empty() || curve.x.back() != x || curve.y.back() != y) {
    if (!curve.x.empty()) curve.x.push_back(no_line), curve.y.push_back(no_line);
    curve.x.push_back(x), curve.y.push_back(y);
  }
  curve.x.push_back(to[0] / scale), curve.y.push_back(to[1] / scale);
}

}  // namespace

Panel network_map(const std::vector<FracturePath>& paths, const std::vector<double>& values, const std::string& title,
                  const DisplayUnit& unit) {
  double farthest = 0;
  std::vector<double> of_cells;
  for (const FracturePath& path : paths) {
    for (const auto& point : path.points) farthest = std::max({farthest, std::abs(point[0]), std::abs(point[1])});
    for (const int cell : path.cells) of_cells.push_back(values[static_cast<std::size_t>(cell)]);
  }
  const DisplayUnit length = display_unit("m", farthest);
  const Classes classes(of_cells);
  Panel panel;
  panel.title = title + (unit.text.empty() ? "" : " [" + unit.text + "]");
  panel.x_label = "x [" + length.text + "]";
  panel.y_label = "y [" + length.text + "]";
  panel.equal_axes = true;
  panel.height = 380;
  for (int k = 0; k < classes.count(); ++k) {
    Curve curve{classes.name(k, unit.scale), {}, {}, {classes.colour(k), ""}};
    panel.curves.push_back(std::move(curve));
  }
  Curve without{"no value", {}, {}, {grey, ""}};
  for (const FracturePath& path : paths)
    for (std::size_t i = 0; i < path.cells.size(); ++i) {
      const double value = values[static_cast<std::size_t>(path.cells[i])];
      Curve& curve = std::isfinite(value) ? panel.curves[static_cast<std::size_t>(classes.of(value))] : without;
      add_way(curve, path.points[i], path.points[i + 1], length.scale);
    }
  if (!without.x.empty()) panel.curves.push_back(std::move(without));
  return panel;
}

}  // namespace sprekk
