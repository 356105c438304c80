#include "framework/picture/line_plot.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <stdexcept>

#include "framework/picture/thinned.hpp"

namespace sprekk {
namespace {

constexpr double letter = 6.2;  // px, the usual width of one at the font size used
constexpr double top = 26, right = 14, bottom = 42, legend_line = 17;
constexpr const char* font = "font-family=\"system-ui, 'Helvetica Neue', Arial, sans-serif\" font-size=\"11\"";

/// Characters, not bytes.
double text_width(const std::string& text) {
  return letter * static_cast<double>(std::count_if(
                      text.begin(), text.end(), [](char c) { return (static_cast<unsigned char>(c) & 0xC0) != 0x80; }));
}

std::vector<double> all_values(const Panel& panel, std::vector<double> Curve::*values) {
  std::vector<double> all;
  for (const Curve& curve : panel.curves) all.insert(all.end(), (curve.*values).begin(), (curve.*values).end());
  return all;
}

/// The frame of the data in px, and what maps data to it.
class Frame {
 public:
  Frame(const Panel& panel)
      : x(all_values(panel, &Curve::x), Axis::Scale::linear, 6),
        y(all_values(panel, &Curve::y), panel.y_scale, 5),
        width(panel.width) {
    double longest = 0;
    for (const Tick& tick : y.ticks()) longest = std::max(longest, text_width(tick.text));
    left = longest + (panel.y_label.empty() ? 14 : 30);
    inner_width = std::max(panel.width - left - right, 40.0);
    inner_height = std::max(panel.height - top - bottom, 40.0);
    if (panel.equal_axes) make_equal();
  }

  double px(double value) const { return left + inner_width * x.fraction(value); }
  double py(double value) const { return top + inner_height * (1 - y.fraction(value)); }

  Axis x, y;
  double left = 0, inner_width = 0, inner_height = 0, width;

 private:
  /// Widens the axis that has more room than its data need.
  void make_equal() {
    const double scale = std::max((x.high() - x.low()) / inner_width, (y.high() - y.low()) / inner_height);
    const double middle_x = (x.low() + x.high()) / 2, middle_y = (y.low() + y.high()) / 2;
    x = Axis(middle_x - scale * inner_width / 2, middle_x + scale * inner_width / 2, 6);
    y = Axis(middle_y - scale * inner_height / 2, middle_y + scale * inner_height / 2, 5);
  }
};

std::string text_at(double x, double y, const std::string& anchor, const std::string& text,
                    const std::string& more = "") {
  return fmt::format("<text x=\"{:.1f}\" y=\"{:.1f}\" text-anchor=\"{}\" {}>{}</text>\n", x, y, anchor, more,
                     escaped_markup(text));
}

std::string axes_text(const Panel& panel, const Frame& frame) {
  std::string out;
  const double base = top + frame.inner_height, end = frame.left + frame.inner_width;
  for (const Tick& tick : frame.x.ticks()) {
    const double x = frame.px(tick.value);
    out += fmt::format("<path d=\"M{0:.1f} {1:.1f}V{2:.1f}\" stroke=\"#e4e4e4\"/>", x, top, base);
    out += text_at(x, base + 15, "middle", tick.text);
  }
  for (const Tick& tick : frame.y.ticks()) {
    const double y = frame.py(tick.value);
    out += fmt::format("<path d=\"M{:.1f} {:.1f}H{:.1f}\" stroke=\"#e4e4e4\"/>", frame.left, y, end);
    out += text_at(frame.left - 5, y + 4, "end", tick.text);
  }
  out += fmt::format(
      "<rect x=\"{:.1f}\" y=\"{:.1f}\" width=\"{:.1f}\" height=\"{:.1f}\" fill=\"none\" stroke=\"#999\"/>\n",
      frame.left, top, frame.inner_width, frame.inner_height);
  out += text_at(frame.left + frame.inner_width / 2, base + 33, "middle", panel.x_label);
  out += text_at(frame.left, 16, "start", panel.title, "font-weight=\"600\" font-size=\"12.5\"");
  if (!panel.y_label.empty())
    out += text_at(0, 0, "middle", panel.y_label,
                   fmt::format("transform=\"translate(12 {:.1f}) rotate(-90)\"", top + frame.inner_height / 2));
  return out;
}

std::string stroke(const Curve& curve) {
  return fmt::format("stroke=\"{}\"{}", curve.style.colour,
                     curve.style.dash.empty() ? "" : " stroke-dasharray=\"" + curve.style.dash + "\"");
}

std::string curve_text(const Curve& whole, const Frame& frame) {
  if (whole.x.size() != whole.y.size()) throw std::logic_error("curve " + whole.name + ": x and y differ in length");
  const Curve curve = thinned(whole);
  std::string path, dots;
  bool is_drawing = false;
  for (std::size_t i = 0; i < curve.x.size(); ++i) {
    const double x = frame.px(curve.x[i]), y = frame.py(curve.y[i]);
    const bool is_point = std::isfinite(x) && std::isfinite(y);
    if (is_point) path += fmt::format("{}{:.1f} {:.1f}", is_drawing ? 'L' : 'M', x, y);
    if (is_point && curve.marked)
      dots += fmt::format("<circle cx=\"{:.1f}\" cy=\"{:.1f}\" r=\"2\" fill=\"{}\"/>", x, y, curve.style.colour);
    is_drawing = is_point;
  }
  if (path.empty()) return "";
  return fmt::format(
      "<g><title>{}</title><path d=\"{}\" fill=\"none\" stroke-width=\"1.6\" stroke-linejoin=\"round\" {}/>{}</g>\n",
      escaped_markup(curve.name), path, stroke(curve), dots);
}

struct Legend {
  std::string text;
  double height = 0;
};

Legend legend(const Panel& panel, const Frame& frame) {
  Legend made;
  double x = frame.left, y = panel.height + 12;
  for (const Curve& curve : panel.curves) {
    if (curve.name.empty()) continue;
    const double width = 26 + text_width(curve.name) + 14;
    if (x > frame.left && x + width > panel.width) {
      x = frame.left;
      y += legend_line;
    }
    made.text += fmt::format("<path d=\"M{:.1f} {:.1f}h20\" stroke-width=\"2.2\" {}/>", x, y - 4, stroke(curve));
    made.text += text_at(x + 25, y, "start", curve.name);
    x += width;
    made.height = y - panel.height + 6;
  }
  return made;
}

struct Drawn {
  std::string text;
  double height;
};

Drawn draw(const Panel& panel) {
  const Frame frame(panel);
  std::string text = axes_text(panel, frame);
  for (const Curve& curve : panel.curves) text += curve_text(curve, frame);
  const Legend below = legend(panel, frame);
  return {text + below.text, panel.height + below.height};
}

std::string opening(double width, double height, const std::string& more) {
  return fmt::format(
      "<svg xmlns=\"http://www.w3.org/2000/svg\" viewBox=\"0 0 {0:.0f} {1:.0f}\" width=\"{0:.0f}\" height=\"{1:.0f}\" "
      "{2} {3}>\n",
      width, height, font, more);
}

}  // namespace

std::string escaped_markup(const std::string& text) {
  std::string result;
  for (const char c : text) {
    switch (c) {
      case '&':
        result += "&amp;";
        break;
      case '<':
        result += "&lt;";
        break;
      case '>':
        result += "&gt;";
        break;
      case '"':
        result += "&quot;";
        break;
      default:
        result += c;
    }
  }
  return result;
}

std::string svg(const Panel& panel) {
  const Drawn drawn = draw(panel);
  return opening(panel.width, drawn.height, "role=\"img\" aria-label=\"" + escaped_markup(panel.title) + "\"") +
         drawn.text + "</svg>\n";
}

std::string svg_document(const std::vector<Panel>& panels, int columns) {
  std::string text;
  double y = 8, width = 0, row_height = 0, x = 0;
  for (std::size_t i = 0; i < panels.size(); ++i) {
    if (i > 0 && i % static_cast<std::size_t>(std::max(columns, 1)) == 0) {
      y += row_height + 12;
      x = row_height = 0;
    }
    const Drawn drawn = draw(panels[i]);
    text += fmt::format("<g transform=\"translate({:.1f} {:.1f})\">\n{}</g>\n", x + 6, y, drawn.text);
    x += panels[i].width + 12;
    width = std::max(width, x);
    row_height = std::max(row_height, drawn.height);
  }
  const double height = y + row_height + 8;
  return "<?xml version=\"1.0\" encoding=\"UTF-8\"?>\n" + opening(width, height, "") +
         "<rect width=\"100%\" height=\"100%\" fill=\"white\"/>\n" + text + "</svg>\n";
}

}  // namespace sprekk
