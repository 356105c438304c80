#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <map>

#include "framework/picture/history_panel.hpp"
#include "framework/report/html.hpp"
#include "framework/report/sections.hpp"

namespace sprekk {
namespace {

constexpr std::size_t most_sequences = 60;

/// The iterations of one attempt of a step of the schedule.
struct Sequence {
  std::string schedule;
  double time;
  std::vector<double> iterations, residuals;
};

std::vector<Sequence> sequences(const CsvTable& coupling) {
  std::vector<Sequence> found;
  const int schedule = coupling.find("schedule"), iteration = coupling.find("iteration[1]");
  const std::vector<double> times = coupling.numbers("time[s]"), residuals = coupling.numbers("residual[1]");
  if (schedule < 0 || iteration < 0 || times.empty() || residuals.empty()) return found;
  const std::vector<std::string> names = coupling.texts(schedule);
  const std::vector<double> numbers = coupling.numbers(iteration);
  std::map<std::string, std::size_t>
      open;  // the last attempt of each step of the schedule: rows of nested steps alternate
  for (std::size_t i = 0; i < times.size(); ++i) {
    const auto same = open.find(names[i]);
    const bool goes_on = same != open.end() && found[same->second].time == times[i] &&
                         numbers[i] > found[same->second].iterations.back();
    if (!goes_on) {
      open[names[i]] = found.size();
      found.push_back({names[i], times[i], {}, {}});
    }
    Sequence& sequence = found[open[names[i]]];
    sequence.iterations.push_back(numbers[i]);
    sequence.residuals.push_back(residuals[i]);
  }
  return found;
}

/// A curve for each attempt, coloured by time from dark to light.
Panel residual_panel(const std::string& schedule, const std::vector<const Sequence*>& all) {
  Panel panel;
  panel.title = schedule;
  panel.x_label = "iteration";
  panel.y_label = "residual / largest term";
  panel.y_scale = Axis::Scale::logarithmic;
  const std::size_t count = std::min(all.size(), most_sequences);
  for (std::size_t i = 0; i < count; ++i) {
    const Sequence& sequence = *all[i * all.size() / count];
    const double fraction = count < 2 ? 0 : static_cast<double>(i) / static_cast<double>(count - 1);
    panel.curves.push_back({"", sequence.iterations, sequence.residuals, {viridis(0.88 * fraction), ""}, true});
  }
  return panel;
}

std::string worst_equations(const CsvTable& coupling) {
  const int equation = coupling.find("equation");
  if (equation < 0) return "";
  std::map<std::string, int> counts;
  for (const std::string& name : coupling.texts(equation))
    if (!name.empty()) ++counts[name];
  std::vector<std::pair<int, std::string>> sorted;
  for (const auto& [name, count] : counts) sorted.emplace_back(-count, name);
  std::sort(sorted.begin(), sorted.end());
  std::vector<std::vector<std::string>> rows = {{"equation with the largest residual", "iterations"}};
  for (const auto& [count, name] : sorted) rows.push_back({name, std::to_string(-count)});
  return rows.size() == 1 ? "" : html_table(rows);
}

}  // namespace

std::string convergence_section(const RunResults& results) {
  const std::vector<double> times = results.history.numbers("time[s]"),
                            iterations = results.history.numbers("iterations[1]");
  const std::vector<Sequence> all = sequences(results.coupling);
  if (iterations.empty() && all.empty()) return "";
  std::vector<Panel> panels;
  std::string text;
  if (!iterations.empty()) {
    if (iterations.size() > 1) {
      panels.push_back(history_panel("iterations of each step", "", {{"", times, iterations, line_style(0)}}));
      panels.push_back(
          history_panel("size of each step", "s", {{"", times, results.history.numbers("step[s]"), line_style(0)}}));
    }
    double sum = 0;
    for (const double value : iterations) sum += value;
    text += html_paragraph(iterations.size() == 1
                               ? fmt::format("1 step with {:.0f} iteration{}.", sum, sum == 1 ? "" : "s")
                               : fmt::format("{} steps with {:.1f} iterations on the average, {:.0f} at most.",
                                             iterations.size(), sum / static_cast<double>(iterations.size()),
                                             *std::max_element(iterations.begin(), iterations.end())));
  }
  std::vector<std::string> schedules;
  std::map<std::string, std::vector<const Sequence*>> by_schedule;
  for (const Sequence& sequence : all) {
    if (by_schedule[sequence.schedule].empty()) schedules.push_back(sequence.schedule);
    by_schedule[sequence.schedule].push_back(&sequence);
  }
  for (const std::string& schedule : schedules) {
    const std::vector<const Sequence*>& its = by_schedule[schedule];
    // One residual for each step (others are 0, which has no logarithm) is no curve.
    if (std::ranges::any_of(its, [](const Sequence* one) {
          return std::ranges::count_if(one->residuals, [](double residual) { return residual > 0; }) > 1;
        }))
      panels.push_back(residual_panel(schedule, its));
  }
  return html_section("convergence", "Convergence", text + html_panels(panels) + worst_equations(results.coupling));
}

}  // namespace sprekk
