#include "framework/meshing/joining/plane/drop_short_segments.hpp"

#include <algorithm>
#include <utility>

#include "framework/mesh/plane/planar.hpp"

namespace sprekk {
namespace {

/// Appends the points of a run that stay, except for its first.
void thin_out(const std::vector<Point>& points, const std::vector<int>& run, double shortest, std::vector<int>& kept) {
  std::vector<std::pair<std::size_t, std::size_t>> parts = {{0, run.size() - 1}};
  std::vector<std::size_t> stay;
  while (!parts.empty()) {
    const auto [first, last] = parts.back();
    parts.pop_back();
    const Segment chord{points[run[first]], points[run[last]]};
    std::size_t farthest = first;
    double most = shortest;
    for (std::size_t i = first + 1; i < last; ++i) {
      const double away = distance(points[run[i]], chord);
      if (away > most) {
        most = away;
        farthest = i;
      }
    }
    if (farthest == first) {
      stay.push_back(last);
    } else {  // the part at the back is next: points are kept in their order
      parts.push_back({farthest, last});
      parts.push_back({first, farthest});
    }
  }
  for (const std::size_t i : stay) kept.push_back(run[i]);
}

}  // namespace

std::vector<int> without_short_segments(const std::vector<Point>& points, double shortest, bool is_closed) {
  const int count = static_cast<int>(points.size());
  const auto is_short = [&](int from, int to) { return (points[to] - points[from]).norm() < shortest; };
  std::vector<int> path;
  int start = 0;  // of a closed line behind a step that is long, if there is one
  while (is_closed && start < count && is_short((start + count - 1) % count, start)) ++start;
  for (int i = 0; i < count; ++i) path.push_back((start + i) % count);
  std::vector<int> kept;
  if (path.empty()) return kept;
  kept.push_back(path.front());
  for (std::size_t i = 0; i + 1 < path.size();) {
    std::size_t end = i + 1;
    if (is_short(path[i], path[end]))
      while (end + 1 < path.size() && is_short(path[end], path[end + 1])) ++end;
    thin_out(points, {path.begin() + static_cast<long>(i), path.begin() + static_cast<long>(end) + 1}, shortest, kept);
    i = end;
  }
  if (is_closed) std::ranges::sort(kept);
  return kept;
}

}  // namespace sprekk
