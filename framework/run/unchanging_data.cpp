#include "framework/run/unchanging_data.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <limits>
#include <regex>
#include <string>
#include <vector>

#include "framework/config/data_reader.hpp"

namespace sprekk {
namespace {

constexpr double forever = std::numeric_limits<double>::infinity();
constexpr std::size_t longest = 500;  // characters: std::regex needs a part of the stack for each

/// A comparison of a variable with a number that has no unit and is no part of a formula.
struct Comparison {
  std::string text;
  char variable;
  double number;
};

std::vector<Comparison> comparisons(const std::string& text) {
  static const std::regex pattern(
      R"(\b([xyt])\s*(?:<=|>=|<|>|==|!=)\s*(-?[0-9]+\.?[0-9]*(?:[eE][-+]?[0-9]+)?)(?![\w.]|\s*[-+*/^(A-Za-z]))");
  std::vector<Comparison> found;
  if (text.size() > longest) return found;
  for (std::sregex_iterator match(text.begin(), text.end(), pattern), end; match != end; ++match)
    found.push_back({match->str(), match->str(1)[0], std::stod(match->str(2))});
  return found;
}

/// "" or why no step or place of the run tells the two sides of the number apart, and what to do.
std::string why_unchanging(const Comparison& one, const RunExtent& run) {
  const double number = one.number;
  if (one.variable == 't') {
    if (number < run.start || number > run.end)
      return fmt::format(
          "(it compares with {:.6g} s, and the run goes from {:.6g} to {:.6g} s) compare with a time of "
          "the run, and write its unit",
          number, run.start, run.end);
    if (number <= run.start || number >= run.start + run.first_step) return "";
    return fmt::format(
        "(it compares with {:.6g} s, and the first step is {:.6g} s long) write the unit, such as '{} h', "
        "or take smaller steps",
        number, run.first_step, one.text);
  }
  const int axis = one.variable - 'x';
  if (number >= run.lowest[axis] && number <= run.highest[axis]) return "";
  return fmt::format(
      "(it compares with {:.6g} m, and the mesh goes from {:.6g} to {:.6g} m) compare with a place of "
      "the mesh, and write its unit, such as '{} mm'",
      number, run.lowest[axis], run.highest[axis], one.text);
}

struct Window {
  const Node* node;
  double from, to;
};

/// Of {value: …, from: …, to: …}.
std::vector<Window> windows_of(const Node& node) {
  std::vector<Window> windows;
  const auto append = [&](const Node& one) {
    const Node *from = one.find("from"), *to = one.find("to");
    if (!one.find("value") || !(from || to)) return;
    windows.push_back(
        {&one, from ? read_number(*from, "s", {}, "from") : -forever, to ? read_number(*to, "s", {}, "to") : forever});
  };
  if (node.is_map()) append(node);
  for (const Node& item : node.items)
    if (item.is_map()) append(item);
  return windows;
}

void note_windows(Notes& notes, const Node& node, const std::string& name, const RunExtent& run) {
  std::vector<Window> windows = windows_of(node);
  for (const Window& window : windows) {
    const bool is_late = window.from >= run.end;
    if (!is_late && window.to > run.start) continue;
    notes.add("window outside of the run at " + window.node->origin.text(),
              fmt::format("{}: a window of '{}' has no effect (it {} {:.6g} s, and the run {} {:.6g} s) move it, or "
                          "{}",
                          window.node->origin.text(), name, is_late ? "begins at" : "ends at",
                          is_late ? window.from : window.to, is_late ? "ends at" : "begins at",
                          is_late ? run.end : run.start, is_late ? "let 'time.end' be later" : "remove it"));
  }
  std::ranges::sort(windows, {}, &Window::from);
  for (std::size_t i = 1; i < windows.size(); ++i) {
    const Window &one = windows[i - 1], &next = windows[i];
    if (next.from >= one.to) continue;
    notes.add("windows that overlap at " + next.node->origin.text(),
              fmt::format("{}: two windows of '{}' overlap from {:.6g} to {:.6g} s (there their values add up) let the "
                          "one end where the other begins, unless the sum is meant",
                          next.node->origin.text(), name, next.from, std::min(one.to, next.to)));
  }
}

void look_at(Notes& notes, const Node& node, const std::string& name, const RunExtent& run) {
  if (node.is_scalar())
    for (const Comparison& one : comparisons(node.scalar))
      if (const std::string why = why_unchanging(one, run); !why.empty())
        notes.add(
            "comparison without effect at " + node.origin.text(),
            fmt::format("{}: '{}' of '{}' is the same throughout the run {}", node.origin.text(), one.text, name, why));
  if (node.is_map() || node.is_list()) note_windows(notes, node, name, run);
  const auto look_inside = [&](const Node& map) {
    for (const Node::Entry& entry : map.entries)
      look_at(notes, entry.value, entry.key == "value" ? name : entry.key, run);
  };
  look_inside(node);
  for (const Node& item : node.items)
    if (windows_of(item).empty())
      look_at(notes, item, name, run);
    else
      look_inside(item);
}

}  // namespace

void note_unchanging_data(Notes& notes, const Node& scene, const RunExtent& run) {
  for (const Node::Entry& section : scene.entries)
    for (const char* with_data : {"materials", "components", "couplers", "schedule"})
      if (section.key == with_data) look_at(notes, section.value, section.key, run);
}

}  // namespace sprekk
