#include "framework/meshing/plane/narrow_gaps.hpp"

#include <algorithm>
#include <limits>
#include <map>
#include <tuple>
#include <utility>

#include "framework/mesh/mesh.hpp"
#include "framework/mesh/search/plane/segment_tree.hpp"

namespace sprekk {
namespace {

/// The largest variation of the width of a gap along one part.
constexpr double evenness = 1.25;
/// Two lines that are connected form a gap only where the path from one to the other along the fractures is at least
/// this many times the gap.
constexpr double least_detour = 1.5;

/// A part of a fracture, given by the arc lengths of its ends, m.
struct Stretch {
  double from, to;
};

double path_between(const Stretch& a, const Stretch& b) { return std::max({0.0, b.from - a.to, a.from - b.to}); }

/// A place where a fracture touches another fracture: the connection between two lines.
struct Joint {
  Stretch at;     ///< on the fracture
  double beyond;  ///< m, the distance from there to the other line, along that line's fracture
};

struct Line {
  Segment segment;
  int fracture;     ///< or none
  Stretch stretch;  ///< on the fracture
};

std::vector<Line> lines_of(const Geometry& geometry) {
  std::vector<Line> lines;
  for (std::size_t f = 0; f < geometry.fractures.size(); ++f) {
    double way = 0;
    const auto& points = geometry.fractures[f].points;
    for (std::size_t i = 0; i + 1 < points.size(); ++i) {
      const Segment segment{points[i], points[i + 1]};
      lines.push_back({segment, static_cast<int>(f), {way, way + segment.length()}});
      way += segment.length();
    }
  }
  const auto add_polygon = [&](const std::vector<Point>& corners) {
    for (std::size_t i = 0; i < corners.size(); ++i)
      lines.push_back({{corners[i], corners[(i + 1) % corners.size()]}, none, {}});
  };
  const auto& [low, high, origin] = geometry.box;
  add_polygon({low, {high.x(), low.y()}, high, {low.x(), high.y()}});
  for (const RegionGeometry& region : geometry.regions) add_polygon(region.polygon);
  return lines;
}

class Search {
 public:
  Search(const Geometry& geometry, const GapLimits& limits, const std::function<double(const Point&)>& wanted,
         const std::function<void(const NarrowGap&)>& keep)
      : lines_(lines_of(geometry)),
        touch_(point_tolerance(geometry.box)),
        limits_(limits),
        wanted_(wanted),
        keep_(keep) {}

  void run() {
    // The narrowest gaps come first: after them most other gaps need no smaller edges.
    std::vector<std::tuple<double, int, int>> pairs;
    std::vector<Segment> segments;
    for (const Line& line : lines_) segments.push_back(line.segment);
    const SegmentTree tree(segments);
    for (int i = 0; i < static_cast<int>(lines_.size()); ++i) {
      const double reach = widest_at(segments[i]);
      for (const int j : tree.near(segments[i], std::max(touch_, reach))) {
        if (i == j || (lines_[i].fracture == none && lines_[j].fracture == none)) continue;
        const double gap = distance(segments[i], segments[j]);
        if (gap < touch_ && j < i) note_touch(lines_[i], lines_[j]);
        if (gap >= touch_ && gap < reach && !are_neighbours(lines_[i], lines_[j], gap))
          pairs.emplace_back(gap, std::max(i, j), std::min(i, j));
      }
    }
    std::ranges::sort(pairs);
    const auto repeated = std::ranges::unique(pairs);
    pairs.erase(repeated.begin(), repeated.end());
    for (const auto& [gap, one, other] : pairs) {
      find_gaps_along(lines_[one], lines_[other]);
      find_gaps_along(lines_[other], lines_[one]);
    }
  }

 private:
  /// The width of gaps beside a line from which on none is narrow: wanted widths vary by the slope at most.
  double widest_at(const Segment& line) const {
    const double most = wanted_(0.5 * (line.from + line.to)) + limits_.slope * line.length();
    return std::min(limits_.widest, most);
  }

  /// Whether two lines of one fracture form no gap, since the path along the fracture is no detour. So most parts of
  /// finely drawn lines are left out early.
  static bool are_neighbours(const Line& line, const Line& other, double gap) {
    if (line.fracture == none || line.fracture != other.fracture) return false;
    const double longer = std::max(line.stretch.to - line.stretch.from, other.stretch.to - other.stretch.from);
    return path_between(line.stretch, other.stretch) + longer < least_detour * gap;
  }

  /// What a line belongs to: its fracture, or itself.
  int whole_of(const Line& line) const {
    return line.fracture != none ? line.fracture : none - 1 - static_cast<int>(&line - lines_.data());
  }

  void note_touch(const Line& line, const Line& other) {
    if (line.fracture != none && line.fracture == other.fracture) return;
    touching_[{whole_of(line), whole_of(other)}].push_back({&line, &other});
    touching_[{whole_of(other), whole_of(line)}].push_back({&other, &line});
  }

  void find_gaps_along(const Line& line, const Line& other) {
    const std::vector<Joint> joints = joints_between(line, other);
    divide(line, {0, 1}, other, joints);
  }

  /// The connections between two lines that do not touch each other themselves.
  std::vector<Joint> joints_between(const Line& line, const Line& other) const {
    if (line.fracture == other.fracture) return {{other.stretch, 0}};
    const Line &of_fracture = line.fracture != none ? line : other, &fixed = line.fracture != none ? other : line;
    std::vector<Joint> joints;
    const auto found = touching_.find({whole_of(of_fracture), whole_of(fixed)});
    if (found == touching_.end()) return joints;
    for (const auto& [next, there] : found->second)
      joints.push_back({next->stretch, fixed.fracture == none ? 0 : path_between(there->stretch, fixed.stretch)});
    return joints;
  }

  /// Infinite without joints.
  static double path_to(const std::vector<Joint>& joints, const Stretch& stretch) {
    double way = std::numeric_limits<double>::infinity();
    for (const Joint& joint : joints) way = std::min(way, path_between(stretch, joint.at) + joint.beyond);
    return way;
  }

  /// Halves the `range` of the line (within 0 to 1) until the width of the gap varies little enough, or the gap is
  /// nowhere narrow.
  void divide(const Line& line, const Stretch& range, const Line& other, const std::vector<Joint>& joints) {
    const auto at = [&](double t) -> Point {
      return t == 1 ? line.segment.to : Point(line.segment.from + t * (line.segment.to - line.segment.from));
    };
    const double half = 0.5 * (range.from + range.to);
    const Segment part{at(range.from), at(range.to)};
    const double gap = distance(part, other.segment), length = part.length();
    const auto [shortest_way, longest_way] = paths_along(line, range, other, joints);
    if (longest_way < least_detour * gap) return;
    double wanted = 0, widest = 0;  // the distance from a segment is convex along a line: widest at an end
    bool is_narrow = false;
    for (const Point& x : {part.from, at(half), part.to}) {
      const double here = distance(x, other.segment), wanted_here = wanted_(x);
      is_narrow = is_narrow || here < wanted_here;
      wanted = std::max(wanted, wanted_here);
      widest = std::max(widest, here);
    }
    // Between its ends and middle, where they are asked for, sizes fall by the slope times a quarter of the length at
    // most.
    constexpr double farthest = 0.25;
    if (gap >= wanted + farthest * limits_.slope * length) return;
    const bool is_even = widest <= std::max(evenness * gap, limits_.least);
    if (is_even && is_narrow && shortest_way >= least_detour * gap) {
      keep_({part, gap});
    } else if (!is_even || length > (evenness - 1) * gap) {
      divide(line, {range.from, half}, other, joints);
      divide(line, {half, range.to}, other, joints);
    }
  }

  /// The length of the path along the fractures from a part of one line to another line: the shortest, and an upper
  /// bound of the longest.
  static Stretch paths_along(const Line& line, const Stretch& range, const Line& other,
                             const std::vector<Joint>& joints) {
    const auto at = [&](double t) { return line.stretch.from + t * (line.stretch.to - line.stretch.from); };
    const Stretch part = line.fracture == none ? other.stretch : Stretch{at(range.from), at(range.to)};
    const double way = path_to(joints, part);
    return {way, line.fracture == none ? way : way + part.to - part.from};
  }

  const std::vector<Line> lines_;
  /// Lines of a whole that touch lines of another one: each pair both ways.
  std::map<std::pair<int, int>, std::vector<std::pair<const Line*, const Line*>>> touching_;
  const double touch_;
  const GapLimits limits_;
  const std::function<double(const Point&)>& wanted_;
  const std::function<void(const NarrowGap&)>& keep_;
};

}  // namespace

void for_each_narrow_gap(const Geometry& geometry, const GapLimits& limits,
                         const std::function<double(const Point&)>& wanted,
                         const std::function<void(const NarrowGap&)>& keep) {
  Search(geometry, limits, wanted, keep).run();
}

}  // namespace sprekk
