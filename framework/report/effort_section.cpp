#include <fmt/format.h>

#include <algorithm>
#include <nlohmann/json.hpp>

#include "framework/output/progress.hpp"
#include "framework/report/html.hpp"
#include "framework/report/sections.hpp"

namespace sprekk {
namespace {

using Json = nlohmann::ordered_json;

std::string row(const std::string& name, long calls, long reuses, long skips, double seconds, double total) {
  const double share = total > 0 ? 100 * seconds / total : 0;
  const auto count = [](long value) { return value < 0 ? std::string() : std::to_string(value); };
  return fmt::format(
      "<tr><td>{}</td><td class=\"number\">{}</td><td class=\"number\">{}</td><td class=\"number\">{}</td>"
      "<td class=\"number\">{}</td><td class=\"number\">{:.1f} %</td>"
      "<td class=\"bar\"><span style=\"width:{:.1f}%\"></span></td></tr>\n",
      escaped_markup(name), count(calls), count(reuses), count(skips), duration_text(seconds), share,
      std::clamp(share, 0.0, 100.0));
}

}  // namespace

std::string effort_section(const RunResults& results) {
  const Json record = Json::parse(results.record);
  Json entries = record.value("profile", Json::array());
  const double total = record.value("seconds", 0.0);
  std::stable_sort(entries.begin(), entries.end(),
                   [](const Json& a, const Json& b) { return a.value("seconds", 0.0) > b.value("seconds", 0.0); });
  std::string text =
      "<table><tr><th></th><th class=\"number\">calls</th><th class=\"number\">reuses</th><th "
      "class=\"number\">skips</th>"
      "<th class=\"number\">time</th><th class=\"number\">share</th><th></th></tr>\n";
  double timed = 0;
  for (const Json& entry : entries) {
    timed += entry.value("seconds", 0.0);
    text += row(entry.value("name", ""), entry.value("calls", 0L), entry.value("reuses", 0L), entry.value("skips", 0L),
                entry.value("seconds", 0.0), total);
  }
  text += row("set-up and others", -1, -1, -1, std::max(total - timed, 0.0), total);
  text += row("whole run", -1, -1, -1, total, total);
  const Json timings = record.value("timings", Json::object());
  for (const char* name : {"factorizations, back-solves", "everything else"})
    if (timings.contains(name)) text += row(name, -1, -1, -1, timings.value(name, 0.0), total);
  text += "</table>\n";
  text += html_paragraph("Reuses and skips are work that was not done, because nothing that it reads had changed.");
  std::vector<std::vector<std::string>> counters = {{"counter", "count"}};
  const Json counted = record.value("counters", Json::object());
  for (const auto& [name, count] : counted.items())
    if (count.is_number_integer()) counters.push_back({name, std::to_string(count.get<long>())});
  if (counters.size() > 1)
    text += "<details><summary>" + std::to_string(counters.size() - 1) + " counters</summary>\n" +
            html_table(counters) + "</details>\n";
  return html_section("effort", "Time and effort", text);
}

}  // namespace sprekk
