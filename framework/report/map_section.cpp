#include <fmt/format.h>

#include "framework/report/html.hpp"
#include "framework/report/map_data.hpp"
#include "framework/report/sections.hpp"

namespace sprekk {

std::string map_section(const RunResults& results) {
  if (results.written.empty()) return "";
  const auto options_of = [](const std::vector<MapField>& fields) {
    std::string options;
    int i = 0;
    for (const MapField& field : fields)
      options += fmt::format("<option value=\"{}\">{}</option>", i++, escaped_markup(field.label));
    return options;
  };
  const std::string options = options_of(map_fields(results)), of_fractures = options_of(fracture_map_fields(results));
  std::string text = fmt::format(
      "<div class=\"controls\">\n"
      "<label>field <select id=\"map-field\">{}</select></label>\n"
      "<label>fractures <select id=\"map-line-field\"><option value=\"-1\">black</option>{}</select></label>\n"
      "<label>time <input type=\"range\" id=\"map-time\" min=\"0\" step=\"1\"> <output "
      "id=\"map-time-text\"></output></label>\n"
      "<button type=\"button\" id=\"map-play\" aria-label=\"all times as a film\">▶</button>\n"
      "<label>colours <select id=\"map-scale\"><option value=\"all\">the same at all times</option>"
      "<option value=\"one\">of this time</option></select></label>\n"
      "<span class=\"buttons\"><button type=\"button\" id=\"map-whole\">whole</button>"
      "<button type=\"button\" id=\"map-lines\">fractures</button>"
      "<button type=\"button\" id=\"map-in\" aria-label=\"zoom in\">+</button>"
      "<button type=\"button\" id=\"map-out\" aria-label=\"zoom out\">−</button></span>\n"
      "</div>\n"
      "<div class=\"map-row\">\n<div><canvas id=\"map\"></canvas>\n<p id=\"map-value\" class=\"quiet\">Point at the "
      "map to read a value; drag to "
      "move it.</p></div>\n"
      "<div id=\"map-small\"></div>\n</div>\n",
      options, of_fractures);
  if (results.written_count > results.written.size())
    text +=
        html_paragraph(fmt::format("{} of {} written times are shown.", results.written.size(), results.written_count));
  return html_section("maps", "Fields",
                      text + "<script type=\"application/json\" id=\"map-data\">" + map_json(results) + "</script>\n");
}

}  // namespace sprekk
