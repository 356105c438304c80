#include "framework/schemes/factor_curves.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <limits>

namespace sprekk {

namespace {

constexpr double alike = 0.01;  // measured factors differ by some thousandths from step to step
constexpr double decades = 30;  // largest over smallest from which on an axis is logarithmic

/// Where the values of an axis stand in a picture: their numbers if all have one unit, else 1, 2, 3.
struct Places {
  std::vector<double> at;
  std::string label;
};

Places places_of(const std::pair<std::string, std::vector<std::string>>& axis) {
  const auto& [path, texts] = axis;
  Places places{{}, path};
  std::string unit;
  for (const std::string& text : texts) {
    char* end = nullptr;
    places.at.push_back(std::strtod(text.c_str(), &end));
    const std::string its(end);
    if (end == text.c_str() || (places.at.size() > 1 && its != unit)) {
      places.at.clear();
      break;
    }
    unit = its;
  }
  if (places.at.empty()) {
    for (std::size_t i = 0; i < texts.size(); ++i) {
      places.at.push_back(static_cast<double>(i + 1));
      places.label += fmt::format("{} {}: {}", i == 0 ? "," : ";", i + 1, texts[i]);
    }
    return places;
  }
  if (unit.find_first_not_of(' ') != std::string::npos)
    places.label += " [" + unit.substr(unit.find_first_not_of(' ')) + "]";
  const auto [low, high] = std::ranges::minmax(places.at);
  if (low > 0 && high > decades * low) {
    for (double& place : places.at) place = std::log10(place);
    places.label = "log10 of " + places.label;
  }
  return places;
}

Curve factor_curve(const AtlasMap& map, std::size_t second, const std::vector<double>& places,
                   SchemeResult::Factor factor) {
  std::vector<std::pair<double, double>> points;
  for (std::size_t i = 0; i < places.size(); ++i)
    points.emplace_back(
        places[i],
        (map.results[second * places.size() + i].*factor).value_or(std::numeric_limits<double>::quiet_NaN()));
  std::ranges::sort(points, {}, &std::pair<double, double>::first);
  Curve curve;
  for (const auto& [x, y] : points) {
    curve.x.push_back(x);
    curve.y.push_back(y);
  }
  return curve;
}

void add_curves(const AtlasMap& map, const std::vector<double>& places, Panel& panel) {
  const std::size_t rows = map.results.size() / places.size();
  for (std::size_t j = 0; j < rows; ++j) {
    const std::string stabilization = map.results.front().scheme.all_stabilizations();
    std::string name = stabilization.empty() ? "plain" : stabilization;
    if (map.axes.size() > 1) name += ", " + map.axes[1].second[j];
    const std::string colour = line_style(static_cast<int>(panel.curves.size() / 2)).colour;
    Curve line = factor_curve(map, j, places, &SchemeResult::predicted),
          points = factor_curve(map, j, places, &SchemeResult::measured);
    line.name = name + ", predicted";
    line.style = {colour, "5 3"};
    points.name = name + ", measured";
    points.style = {colour, ""};
    points.marked = true;
    panel.curves.push_back(line);
    panel.curves.push_back(points);
  }
}

void choose_scale(Panel& panel) {
  double low = std::numeric_limits<double>::infinity(), high = 0;
  for (const Curve& curve : panel.curves)
    for (const double value : curve.y)
      if (value > 0) {
        low = std::min(low, value);
        high = std::max(high, value);
      }
  if (high > decades * low) panel.y_scale = Axis::Scale::logarithmic;
}

}  // namespace

std::optional<Optimum> optimum(const AtlasMap& map, SchemeResult::Factor factor) {
  std::optional<Optimum> best;
  double largest = 0;
  for (std::size_t k = 0; k < map.results.size(); ++k) {
    const std::optional<double> value = map.results[k].*factor;
    if (!value) continue;
    if (!best || *value < best->factor) best = {k, *value};
    largest = std::max(largest, *value);
  }
  return best && largest > (1 + alike) * best->factor ? best : std::nullopt;
}

std::vector<std::vector<std::string>> optimum_rows(const std::vector<AtlasMap>& maps) {
  std::vector<std::vector<std::string>> rows = {{"scheme", "smallest factor", "at", "smallest predicted", "at"}};
  for (const AtlasMap& map : maps) {
    if (!map.has_predictions()) continue;
    std::vector<std::string> row = {map.results.front().scheme.whole_name()};
    for (const SchemeResult::Factor factor : {&SchemeResult::measured, &SchemeResult::predicted}) {
      const std::optional<Optimum> best = optimum(map, factor);
      std::string at;
      if (best)
        for (const std::string& value : map.values_at(best->place)) at += (at.empty() ? "" : ", ") + value;
      row.push_back(best ? fmt::format("{:.3g}", best->factor) : "–");
      if (best && map.axes.size() == 1 && (best->place == 0 || best->place + 1 == map.results.size()))
        at += " or beyond";
      row.push_back(best ? at : "–");
    }
    rows.push_back(row);
  }
  return rows;
}

std::vector<Panel> factor_panels(const std::vector<AtlasMap>& maps) {
  std::vector<Panel> panels;
  for (const AtlasMap& map : maps) {
    if (!map.has_predictions()) continue;
    const Places places = places_of(map.axes[0]);
    const Scheme& scheme = map.results.front().scheme;
    const std::string split = Scheme{scheme.groups, scheme.is_jacobi, {}, ""}.split();
    if (panels.empty() || panels.back().title != split) {
      panels.emplace_back();
      panels.back().title = split;
      panels.back().x_label = places.label;
      panels.back().y_label = "factor of a pass";
    }
    add_curves(map, places.at, panels.back());
  }
  for (Panel& panel : panels) choose_scale(panel);
  return panels;
}

std::string factors_svg(const std::vector<AtlasMap>& maps) { return svg_document(factor_panels(maps), 2); }

}  // namespace sprekk
