#include "framework/schemes/atlas_page.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <set>

#include "framework/report/html.hpp"
#include "framework/schemes/atlas_tables.hpp"
#include "framework/schemes/factor_curves.hpp"
#include "framework/schemes/scheme_picture.hpp"

namespace sprekk {

namespace {

std::string with_acceleration(const Scheme& scheme) {
  return scheme.split() + (scheme.acceleration.empty() ? "" : ", " + scheme.acceleration);
}

std::string summary(const std::vector<SchemeResult>& results) {
  const auto done = std::ranges::count_if(results, [](const SchemeResult& result) { return result.is_done; });
  std::string text = html_paragraph(fmt::format("{} of {} schemes converge.", done, results.size()));
  if (const SchemeResult* best = cheapest(results, false))
    text += html_paragraph(
        fmt::format("Cheapest: {} ({:.3g} s of the processor).", with_acceleration(best->scheme), best->processor));
  if (const SchemeResult* best = cheapest(results, true))
    text += html_paragraph(fmt::format("Cheapest split: {} ({} passes in {} steps, {:.3g} s).",
                                       with_acceleration(best->scheme), best->total_passes(), best->passes.size(),
                                       best->processor));
  double largest = 0;
  for (const SchemeResult& result : results) largest = std::max(largest, result.difference.value_or(0));
  return text + html_paragraph(fmt::format("The largest difference of any field from the monolithic answer, over the "
                                           "largest value of its unit, is {:.1g}.",
                                           largest));
}

std::string failures(const std::vector<SchemeResult>& results) {
  std::vector<std::vector<std::string>> rows = {{"scheme", "why it did not converge"}};
  for (const SchemeResult& result : results)
    if (!result.is_done) rows.push_back({with_acceleration(result.scheme), result.reason});
  return rows.size() > 1 ? html_table(rows, 2) : "";
}

/// Each split once, whatever the acceleration.
std::string pictures(const std::vector<SchemeResult>& results) {
  std::string text = "<div class=\"panels\">\n";
  std::set<std::string> drawn;
  for (const SchemeResult& result : results)
    if (drawn.insert(result.scheme.split()).second) text += "<figure>" + scheme_svg(result.scheme) + "</figure>\n";
  return text + "</div>\n";
}

std::string maps_of(const std::vector<AtlasMap>& maps) {
  if (maps.empty()) return "";
  std::string text = html_table(optimum_rows(maps), 1) + "<div class=\"panels\">\n";
  for (const Panel& panel : factor_panels(maps)) text += "<figure>" + svg(panel) + "</figure>\n";
  text += "</div>\n" + html_paragraph(
                           "Below: passes of all steps together, grey where a step does not converge, and "
                           "factors of a pass.");
  for (const AtlasMap& map : maps) {
    text += "<h3>" + escaped_markup(map.results.front().scheme.whole_name()) + "</h3>\n<div class=\"panels\">\n";
    for (const MapFigure& figure : map_figures())
      if (std::ranges::any_of(map.results, [&](const SchemeResult& result) { return figure.of(result).has_value(); }))
        text += "<figure>" + map_svg(map, figure) + "<figcaption>" + figure.name + "</figcaption></figure>\n";
    text += "</div>\n";
  }
  return text;
}

}  // namespace

std::string atlas_page(const std::string& scene, const std::vector<SchemeResult>& results,
                       const std::vector<AtlasMap>& maps) {
  const std::string body = html_section("summary", "Summary", summary(results)) +
                           html_section("schemes", "Schemes", html_table(result_rows(results), 2)) +
                           html_section("splits", "Splits", pictures(results)) +
                           html_section("maps", "Maps", maps_of(maps)) +
                           html_section("failures", "Not converged", failures(results));
  return html_page("Schemes of " + scene,
                   {{"summary", "Summary"},
                    {"schemes", "Schemes"},
                    {"splits", "Splits"},
                    {"maps", "Maps"},
                    {"failures", "Not converged"}},
                   body);
}

}  // namespace sprekk
