#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "framework/report/html.hpp"
#include "framework/report/sections.hpp"

namespace sprekk {

std::string events_section(const RunResults& results) {
  const CsvTable& events = results.events;
  if (events.row_count() == 0) return "";
  std::vector<std::vector<std::string>> rows(events.row_count() + 1);
  for (std::size_t i = 0; i < events.columns().size(); ++i) {
    const int column = static_cast<int>(i);
    const std::vector<std::string> texts = events.texts(column);
    const std::vector<double> numbers = events.numbers(column);
    const auto has_text = [](const std::string& text) { return !text.empty(); };
    if (std::ranges::none_of(texts, has_text)) continue;
    rows[0].push_back(events.columns()[i]);
    for (std::size_t row = 0; row < texts.size(); ++row)
      rows[row + 1].push_back(std::isfinite(numbers[row]) ? fmt::format("{:.6g}", numbers[row]) : texts[row]);
  }
  return html_section("events", "Events",
                      fmt::format("<details open><summary>{} in events.csv</summary>\n", events.row_count()) +
                          html_table(rows) + "</details>\n");
}

HistoryCurve event_points() { return {"events", {}, {}, {"#000000", ""}, true}; }

void add_event_points(HistoryCurve& points, const CsvTable& events, const std::string& thing,
                      const HistoryCurve& curve) {
  if (events.row_count() == 0) return;
  const std::vector<double> times = events.numbers("time[s]");
  const std::vector<std::string> things = events.texts(events.find("thing"));
  for (std::size_t i = 0; i < times.size(); ++i) {
    const auto at = std::ranges::find(curve.times, times[i]);
    if (things[i] != thing || at == curve.times.end()) continue;
    points.times.push_back(times[i]);
    points.values.push_back(curve.values[at - curve.times.begin()]);
  }
}

}  // namespace sprekk
