#include "framework/output/profile.hpp"

#include <fmt/format.h>

#include <algorithm>

namespace sprekk {

std::string Profile::table(double total_seconds) const {
  std::vector<Entry> rows(entries_.begin(), entries_.end());
  std::stable_sort(rows.begin(), rows.end(), [](const Entry& a, const Entry& b) { return a.seconds > b.seconds; });
  double rest = total_seconds;
  std::size_t width = std::string_view("everything else").size();
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
  text += fmt::format("{:<{}} {} {:>10.3f} {:>5.1f} %\n", "everything else", width, blank, rest, share(rest));
  text += fmt::format("{:<{}} {} {:>10.3f} {:>5.1f} %\n", "total", width, blank, total_seconds, share(total_seconds));
  return text;
}

}  // namespace sprekk
