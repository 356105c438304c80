#include "framework/schemes/scheme_picture.hpp"

#include <fmt/format.h>

#include <algorithm>

#include "framework/picture/colours.hpp"
#include "framework/picture/line_plot.hpp"

namespace sprekk {

namespace {

constexpr double line = 16, margin = 10, gap = 46, letter = 7.5, box_margin = 12;

std::string text_at(double x, double y, const std::string& text, const std::string& more = "") {
  return fmt::format("<text x=\"{:.1f}\" y=\"{:.1f}\" font-size=\"12\" font-family=\"sans-serif\" {}>{}</text>\n", x, y,
                     more, escaped_markup(text));
}

std::string opening(double width, double height, const std::string& label) {
  return fmt::format(
      "<svg xmlns=\"http://www.w3.org/2000/svg\" width=\"{:.0f}\" height=\"{:.0f}\" viewBox=\"0 0 {:.0f} {:.0f}\" "
      "role=\"img\" aria-label=\"{}\">\n",
      width, height, width, height, escaped_markup(label));
}

std::string arrow(double x1, double y1, double x2, double y2) {
  const double back = x2 > x1 ? -6 : 6;
  return fmt::format(
      "<path d=\"M{:.1f} {:.1f} L{:.1f} {:.1f} m{:.1f} -4 l{:.1f} 4 l{:.1f} 4\" fill=\"none\" stroke=\"#555\"/>\n", x1,
      y1, x2, y2, back, -back, back);
}

}  // namespace

std::string scheme_svg(const Scheme& scheme) {
  std::size_t most = 0;
  for (const Group& group : scheme.groups) most = std::max(most, group.size());
  const double height = static_cast<double>(most) * line + 2 * margin + (scheme.stabilizations.empty() ? 0 : line);
  const double top = margin, bottom = top + height;
  std::string text;
  double x = margin;
  std::vector<std::pair<double, double>> boxes;
  for (std::size_t g = 0; g < scheme.groups.size(); ++g) {
    std::vector<std::string> words = scheme.groups[g];
    const std::string stabilization = scheme.stabilization(g);
    std::size_t letters = stabilization.empty() ? 0 : stabilization.size() + 2;
    for (const std::string& word : words) letters = std::max(letters, word.size());
    const double width = letter * static_cast<double>(letters) + 2 * box_margin;
    text += fmt::format(
        "<rect x=\"{:.1f}\" y=\"{:.1f}\" width=\"{:.1f}\" height=\"{:.1f}\" rx=\"6\" fill=\"#e8eef2\" "
        "stroke=\"#555\"/>\n",
        x, top, width, height);
    double y = top + margin + line / 2;
    for (const std::string& word : words) {
      text += text_at(x + box_margin, y + 4, word);
      y += line;
    }
    if (!stabilization.empty()) text += text_at(x + box_margin, y + 4, "+ " + stabilization, "fill=\"#b04000\"");
    boxes.emplace_back(x, x + width);
    x += width + gap;
  }
  const double middle = (top + bottom) / 2, below = bottom + 14;
  for (std::size_t g = 1; g < boxes.size(); ++g) {
    text += arrow(boxes[g - 1].second + 4, scheme.is_jacobi ? middle - 8 : middle, boxes[g].first - 4,
                  scheme.is_jacobi ? middle - 8 : middle);
    if (scheme.is_jacobi) text += arrow(boxes[g].first - 4, middle + 8, boxes[g - 1].second + 4, middle + 8);
  }
  if (boxes.size() > 1 && !scheme.is_jacobi) {  // back to the first
    const double last = (boxes.back().first + boxes.back().second) / 2, first = (boxes[0].first + boxes[0].second) / 2;
    text += fmt::format(
        "<path d=\"M{:.1f} {:.1f} V{:.1f} H{:.1f} V{:.1f} m-4 6 l4 -6 l4 6\" fill=\"none\" stroke=\"#555\" "
        "stroke-dasharray=\"4 3\"/>\n",
        last, bottom + 2, below, first, bottom + 3);
  }
  return opening(boxes.back().second + margin, below + margin, scheme.split()) + text + "</svg>\n";
}

const std::vector<MapFigure>& map_figures() {
  static const std::vector<MapFigure> figures = {
      {"passes",
       [](const SchemeResult& result) {
         return result.is_done ? std::optional<double>(result.total_passes()) : std::nullopt;
       },
       0},
      {"measured factor", [](const SchemeResult& result) { return result.measured; }, 1},
      {"predicted factor", [](const SchemeResult& result) { return result.predicted; }, 1}};
  return figures;
}

std::string map_svg(const AtlasMap& map, const MapFigure& figure) {
  constexpr double cell_width = 74, cell_height = 34, left = 150, above = 46;
  const std::vector<std::string> one = {""};
  const std::vector<std::string>&first = map.axes[0].second, &second = map.axes.size() > 1 ? map.axes[1].second : one;
  double largest = figure.bright;
  if (largest == 0)
    for (const SchemeResult& result : map.results) largest = std::max(largest, figure.of(result).value_or(0));
  std::string text = text_at(left, 16, map.axes[0].first);
  if (map.axes.size() > 1) text += text_at(4, above - 8, map.axes[1].first);
  for (std::size_t i = 0; i < first.size(); ++i)
    text += text_at(left + cell_width * (static_cast<double>(i) + 0.1), above - 8, first[i]);
  for (std::size_t j = 0; j < second.size(); ++j) {
    const double y = above + cell_height * static_cast<double>(j);
    text += text_at(4, y + cell_height / 2 + 4, second[j]);
    for (std::size_t i = 0; i < first.size(); ++i) {
      const std::optional<double> value = figure.of(map.results[j * first.size() + i]);
      const double share = value ? std::min(*value / largest, 1.0) : 1, x = left + cell_width * static_cast<double>(i);
      text += fmt::format("<rect x=\"{:.1f}\" y=\"{:.1f}\" width=\"{}\" height=\"{}\" fill=\"{}\" stroke=\"#fff\"/>\n",
                          x, y, cell_width, cell_height, value ? viridis(share) : "#cccccc");
      text += text_at(x + cell_width / 2, y + cell_height / 2 + 4, value ? fmt::format("{:.4g}", *value) : "no",
                      share < 0.6 ? "fill=\"#fff\" text-anchor=\"middle\"" : "text-anchor=\"middle\"");
    }
  }
  return opening(left + cell_width * static_cast<double>(first.size()) + margin,
                 above + cell_height * static_cast<double>(second.size()) + margin, figure.name + " of " + map.scheme) +
         text + "</svg>\n";
}

}  // namespace sprekk
