// Line plots as SVG.
//
//   Panel panel{.title = "pressure", .x_label = "t [h]", .y_label = "MPa"};
//   panel.curves.push_back({.name = "p_C", .x = hours, .y = megapascals, .style = line_style(0)});
//   write_atomically("plot.svg", svg_document({panel}, 2));
#pragma once

#include <string>
#include <vector>

#include "framework/picture/axis.hpp"
#include "framework/picture/curve.hpp"

namespace sprekk {

/// A plot of several curves.
struct Panel {
  std::string title, x_label, y_label;
  std::vector<Curve> curves;
  Axis::Scale y_scale = Axis::Scale::linear;
  bool equal_axes = false;           ///< one length on both axes: for maps
  double width = 440, height = 300;  ///< px, without the legend below
};

/// An `<svg>` element that can stand in a page; a curve of very many points is thinned to what can be seen.
std::string svg(const Panel& panel);

/// The panels as one SVG file, `columns` beside each other.
std::string svg_document(const std::vector<Panel>& panels, int columns);

/// `text` with & < > " written as entities: for SVG and HTML.
std::string escaped_markup(const std::string& text);

}  // namespace sprekk
