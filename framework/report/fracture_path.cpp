#include "framework/report/fracture_path.hpp"

#include <algorithm>
#include <cmath>
#include <map>
#include <set>

namespace sprekk {
namespace {

using Position = std::array<double, 2>;

double distance(const Position& a, const Position& b) { return std::hypot(a[0] - b[0], a[1] - b[1]); }

/// Line cells as a graph; its nodes are the places where they end.
class Graph {
 public:
  Graph(const Grid& grid, const std::vector<int>& cells) : grid_(grid) {
    for (const int cell : cells)
      for (const int end : {0, 1}) touching_[position(cell, end)].push_back(cell);
    left_.insert(cells.begin(), cells.end());
  }

  bool is_done() const { return left_.empty(); }

  /// Takes one path out of the graph: from an end if there is one, else from anywhere, as far as it goes.
  FracturePath take_path() {
    FracturePath path;
    path.points.push_back(beginning());
    for (;;) {
      const std::vector<int>& here = touching_[path.points.back()];
      const auto next = std::find_if(here.begin(), here.end(), [&](int cell) { return left_.count(cell) > 0; });
      if (next == here.end()) return path;
      left_.erase(*next);
      path.cells.push_back(*next);
      path.points.push_back(position(*next, position(*next, 0) == path.points.back() ? 1 : 0));
    }
  }

 private:
  Position position(int cell, int end) const {
    return grid_.points[static_cast<std::size_t>(grid_.cells[static_cast<std::size_t>(2 * cell + end)])];
  }
  Position beginning() const {
    for (const int cell : left_)
      for (const int end : {0, 1})
        if (std::count_if(touching_.at(position(cell, end)).begin(), touching_.at(position(cell, end)).end(),
                          [&](int other) { return left_.count(other) > 0; }) == 1)
          return position(cell, end);
    return position(*left_.begin(), 0);
  }

  const Grid& grid_;
  std::map<Position, std::vector<int>> touching_;
  std::set<int> left_;
};

void reverse(FracturePath& path) {
  std::reverse(path.points.begin(), path.points.end());
  std::reverse(path.cells.begin(), path.cells.end());
}

std::size_t nearest(const std::vector<Position>& points, const Position& wanted) {
  return static_cast<std::size_t>(std::min_element(points.begin(), points.end(),
                                                   [&](const Position& a, const Position& b) {
                                                     return distance(a, wanted) < distance(b, wanted);
                                                   }) -
                                  points.begin());
}

/// Arc lengths along the path, 0 at the point `zero`.
void measure(FracturePath& path, std::size_t zero) {
  std::vector<double> along(1, 0.0);
  for (std::size_t i = 1; i < path.points.size(); ++i)
    along.push_back(along.back() + distance(path.points[i - 1], path.points[i]));
  for (std::size_t i = 0; i < path.cells.size(); ++i)
    path.length.push_back((along[i] + along[i + 1]) / 2 - along[zero]);
  path.start = -along[zero];
  path.end = along.back() - along[zero];
}

}  // namespace

std::vector<FracturePath> fracture_paths(const Grid& grid, const std::vector<int>& cells,
                                         std::optional<PathOrigin>& origin) {
  std::vector<FracturePath> paths;
  Graph graph(grid, cells);
  while (!graph.is_done()) {
    FracturePath path = graph.take_path();
    if (!paths.empty()) {  // a further piece goes on where the last one ended
      measure(path, 0);
      const double offset = paths.back().end;
      for (double& length : path.length) length += offset;
      path.start += offset;
      path.end += offset;
      paths.push_back(std::move(path));
      continue;
    }
    if (!origin) {
      if (path.points.back() < path.points.front()) reverse(path);
      origin = {path.points.front(), path.points.back()};
    }
    if (nearest(path.points, origin->first) > nearest(path.points, origin->last)) reverse(path);
    measure(path, nearest(path.points, origin->first));
    paths.push_back(std::move(path));
  }
  return paths;
}

}  // namespace sprekk
