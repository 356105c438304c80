#include "framework/output/profile.hpp"

#include <fmt/format.h>

#include <algorithm>

namespace sprekk {

std::string Profile::table(double total_seconds) const {
  std::vector<Entry> rows(entries_.begin(), entries_.end());
  std::stable_sort(rows.begin(), rows.end(), [](const Entry& a, const Entry& b) { return a.seconds > b.seconds; });
  double rest = total_seconds;
  constexpr std::string_view others = "set-up and others", solvers = "factorizations, back-solves";
  std::size_t width = solvers.size();
  for (const Entry& row : rows) {
    rest -= row.seconds;
    width = std::max(width, row.name.size());
  }
  const auto share = [&](double seconds) { return total_seconds > 0 ? 100 * seconds / total_seconds : 0.0; };

  std::string text =
      fmt::format("{:<{}} {:>9} {:>9} {:>9} {:>10} {:>7}\n", "", width, "calls", "reuses", "skips", "seconds", "share");
  for (const Entry& row : rows)
    text += fmt::format("{:<{}} {:>9} {:>9} {:>9} {:>10.3f} {:>5.1f} %\n", row.name, width, row.calls, row.reuses,
                        row.skips, row.seconds, share(row.seconds));
  const std::string blank(29, ' ');
  const auto add_sum = [&](std::string_view name, double seconds) {
    text += fmt::format("{:<{}} {} {:>10.3f} {:>5.1f} %\n", name, width, blank, seconds, share(seconds));
  };
  add_sum(others, rest);
  add_sum("total", total_seconds);
  add_sum(solvers, solver_seconds());
  add_sum("everything else", total_seconds - solver_seconds());
  return text;
}

}  // namespace sprekk
