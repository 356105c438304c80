#include "framework/meshing/joining/plane/join_lines.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <map>
#include <numeric>
#include <optional>
#include <tuple>

#include "framework/config/input_error.hpp"
#include "framework/mesh/mesh.hpp"
#include "framework/mesh/search/plane/segment_tree.hpp"
#include "framework/round_off.hpp"

namespace sprekk {
namespace {

/// Rounds of joining after which lines are called entangled. Networks of hundreds of lines take three to six.
constexpr int most_rounds = 100;

struct Place {
  Point at;
  std::array<bool, dimension> is_fixed{};  ///< along x and y: of the sides of the box
  double weight = 1;                       ///< the points that are there
  bool has_moved = false;
  bool is_on_line = false;  ///< it lies on the inside of another line, and stays there
};

class Joiner {
 public:
  Joiner(const Box& box, const std::vector<LineToJoin>& lines, double reach, double same)
      : reach_((1 + rounding::far_above) * reach), same_(same) {
    for (const LineToJoin& line : lines) add(line);
    add_box(box);
  }

  JoinedLines join() {
    for (int round = 0; round < most_rounds; ++round) {
      bool has_changed = false;
      while (join_places()) has_changed = true;
      has_changed = join_places_and_lines() || has_changed;
      has_changed = cut_at_crossings() || has_changed;
      if (!has_changed) return result();
    }
    throw InputError(
        fmt::format("lines are entangled (joining what is nearer than {:.3g} m finds no end) lower "
                    "geometry.snap",
                    reach_));
  }

 private:
  struct Piece {
    int line, from;  ///< between the places `from` and from + 1 of the line
  };
  struct Insertion {
    int line, after;
    double along;  ///< from 0 to 1 on the piece
    int place;
    auto operator<=>(const Insertion&) const = default;
  };

  void add(const LineToJoin& line) {
    JoinedLine joined;
    for (std::size_t i = 0; i < line.points.size(); ++i) {
      joined.places.push_back(place_at(line.points[i]));
      joined.points.push_back(static_cast<int>(i));
    }
    if (line.is_closed) {
      joined.places.push_back(joined.places.front());
      joined.points.push_back(none);
    }
    lines_.push_back(std::move(joined));
    is_closed_.push_back(line.is_closed);
  }

  /// The sides are one closed line, the last one, whose places do not leave them.
  void add_box(const Box& box) {
    add({{box.low, {box.high.x(), box.low.y()}, box.high, {box.low.x(), box.high.y()}}, true});
    for (const int corner : lines_.back().places) places_[corner].is_fixed = {true, true};
  }

  int place_at(const Point& x) {
    const auto [known, is_new] = known_.try_emplace({x.x(), x.y()}, static_cast<int>(places_.size()));
    if (is_new) {
      places_.push_back({x});
      joined_with_.push_back(known->second);
    } else {
      places_[known->second].weight += 1;
    }
    return known->second;
  }

  int place(int number) {
    while (joined_with_[number] != number) number = joined_with_[number] = joined_with_[joined_with_[number]];
    return number;
  }

  bool is_box(int line) const { return line + 1 == static_cast<int>(lines_.size()); }

  /// Whether the place may lie on a side: not where an open line only passes.
  std::vector<char> may_touch_sides() const {
    std::vector<char> may(places_.size(), 1);
    for (std::size_t l = 0; l < lines_.size(); ++l)
      for (std::size_t i = 1; !is_closed_[l] && i + 1 < lines_[l].places.size(); ++i) may[lines_[l].places[i]] = 0;
    return may;
  }

  std::vector<int> used_places() const {
    std::vector<int> used;
    for (const JoinedLine& line : lines_) used.insert(used.end(), line.places.begin(), line.places.end());
    std::ranges::sort(used);
    const auto repeated = std::ranges::unique(used);
    used.erase(repeated.begin(), repeated.end());
    return used;
  }

  // Places near other places.

  bool join_places() {
    const std::vector<int> used = used_places();
    std::vector<Segment> points;
    for (const int number : used) points.push_back({places_[number].at, places_[number].at});
    const SegmentTree tree(points);
    std::vector<std::tuple<double, int, int>> near;
    for (std::size_t i = 0; i < used.size(); ++i)
      for (const int j : tree.near(points[i], reach_)) {
        const double gap = (points[i].from - points[j].from).norm();
        if (j < static_cast<int>(i) && gap < reach_) near.emplace_back(gap, used[j], used[i]);
      }
    std::ranges::sort(near);
    bool has_changed = false;
    for (const auto& [gap, one, other] : near) has_changed = join_pair(place(one), place(other)) || has_changed;
    if (has_changed) rename_places();
    return has_changed;
  }

  bool join_pair(int one, int other) {
    Place &a = places_[one], &b = places_[other];
    const double gap = (a.at - b.at).norm();
    if (one == other || gap >= reach_) return false;
    for (int axis = 0; axis < dimension; ++axis)
      if (a.is_fixed[axis] && b.is_fixed[axis] && a.at[axis] != b.at[axis]) return false;
    const Point mean = gap < same_ ? a.at : Point((a.weight * a.at + b.weight * b.at) / (a.weight + b.weight));
    for (int axis = 0; axis < dimension; ++axis) {
      if (b.is_fixed[axis]) a.at[axis] = b.at[axis];
      if (!a.is_fixed[axis] && !b.is_fixed[axis]) a.at[axis] = mean[axis];
      a.is_fixed[axis] = a.is_fixed[axis] || b.is_fixed[axis];
    }
    a.weight += b.weight;
    a.has_moved = a.has_moved || b.has_moved || gap >= same_;
    a.is_on_line = a.is_on_line || b.is_on_line;
    joined_with_[other] = one;
    return true;
  }

  /// Leaves out steps from a place to itself, and steps to a place and back that joining has made: a line that folds
  /// back over more is refused later (validate_fracture).
  void rename_places() {
    constexpr double most_folded = 2;  // of `reach`, by which both ends of a step may have moved
    for (std::size_t l = 0; l < lines_.size(); ++l) {
      JoinedLine shorter;
      const JoinedLine& line = lines_[l];
      for (std::size_t i = 0; i < line.places.size(); ++i) {
        const int next = place(line.places[i]);
        if (!shorter.places.empty() && shorter.places.back() == next) {
          if (shorter.points.back() == none) shorter.points.back() = line.points[i];
          continue;
        }
        const std::size_t count = shorter.places.size();
        const bool goes_back = !is_closed_[l] && count >= 2 && shorter.places[count - 2] == next;
        if (goes_back && (places_[shorter.places.back()].at - places_[next].at).norm() < most_folded * reach_) {
          shorter.places.pop_back();
          shorter.points.pop_back();
          continue;
        }
        shorter.places.push_back(next);
        shorter.points.push_back(line.points[i]);
      }
      lines_[l] = std::move(shorter);
    }
  }

  // Places near lines.

  std::vector<Piece> pieces() const {
    std::vector<Piece> pieces;
    for (int l = 0; l < static_cast<int>(lines_.size()); ++l)
      for (int i = 0; i + 1 < static_cast<int>(lines_[l].places.size()); ++i) pieces.push_back({l, i});
    return pieces;
  }

  std::array<int, 2> ends(const Piece& piece) const {
    const std::vector<int>& places = lines_[piece.line].places;
    return {places[piece.from], places[piece.from + 1]};
  }

  Segment segment(const Piece& piece) const {
    const auto [from, to] = ends(piece);
    return {places_[from].at, places_[to].at};
  }

  std::vector<Segment> segments(const std::vector<Piece>& pieces) const {
    std::vector<Segment> segments;
    for (const Piece& piece : pieces) segments.push_back(segment(piece));
    return segments;
  }

  bool join_places_and_lines() {
    const std::vector<Piece> all = pieces();
    const SegmentTree tree(segments(all));
    const std::vector<char> may_touch = may_touch_sides();
    std::vector<std::tuple<double, int, int>> near;  // distance, place, piece
    for (const int number : used_places())
      for (const int p : tree.near({places_[number].at, places_[number].at}, reach_)) {
        if (is_box(all[p].line) && !may_touch[number]) continue;
        if (const auto gap = gap_inside(number, all[p])) near.emplace_back(*gap, number, p);
      }
    std::ranges::sort(near);
    std::vector<Insertion> insertions;
    for (const auto& [gap, number, p] : near)
      if (const auto insertion = put_on_line(number, all[p])) insertions.push_back(*insertion);
    insert(std::move(insertions));
    return !near.empty();
  }

  /// The distance of a place from the inside of a piece, if it is within reach.
  std::optional<double> gap_inside(int number, const Piece& piece) const {
    const auto [from, to] = ends(piece);
    if (number == from || number == to) return std::nullopt;
    const Segment line = segment(piece);
    const double along = position(places_[number].at, line), gap = distance(places_[number].at, line);
    if (!(along > 0 && along < 1 && gap < reach_)) return std::nullopt;
    return gap;
  }

  static double position(const Point& x, const Segment& line) {
    const Point along = line.to - line.from;
    return (x - line.from).dot(along) / along.squaredNorm();
  }

  std::optional<Insertion> put_on_line(int number, const Piece& piece) {
    if (!gap_inside(number, piece)) return std::nullopt;  // it has moved since
    Place& place = places_[number];
    const Segment line = segment(piece);
    const double along = position(place.at, line), gap = distance(place.at, line);
    if (is_box(piece.line)) {
      const auto [from, to] = ends(piece);
      for (int axis = 0; axis < dimension; ++axis) {
        if (places_[from].at[axis] != places_[to].at[axis]) continue;
        place.at[axis] = places_[from].at[axis];
        place.is_fixed[axis] = true;
      }
      place.has_moved = place.has_moved || gap >= same_;
    } else if (gap >= same_) {
      const Point onto = line.from + along * (line.to - line.from);
      for (int axis = 0; axis < dimension && !place.is_on_line; ++axis)
        if (!place.is_fixed[axis]) place.at[axis] = onto[axis];
      place.has_moved = true;
    }
    place.is_on_line = true;
    return Insertion{piece.line, piece.from, along, number};
  }

  void insert(std::vector<Insertion> insertions) {
    std::ranges::sort(insertions);
    for (auto next = insertions.begin(); next != insertions.end();) {
      JoinedLine &line = lines_[next->line], longer;
      const int number = next->line;
      for (int i = 0; i < static_cast<int>(line.places.size()); ++i) {
        longer.places.push_back(line.places[i]);
        longer.points.push_back(line.points[i]);
        for (; next != insertions.end() && next->line == number && next->after == i; ++next) {
          longer.places.push_back(next->place);
          longer.points.push_back(none);
        }
      }
      line = std::move(longer);
    }
    if (!insertions.empty()) rename_places();
  }

  // Crossings.

  bool cut_at_crossings() {
    const std::vector<Piece> all = pieces();
    const std::vector<Segment> lines = segments(all);
    const SegmentTree tree(lines);
    std::vector<Insertion> insertions;
    Point crossing;
    for (int p = 0; p < static_cast<int>(all.size()); ++p)
      for (const int q : tree.near(lines[p], 0)) {
        if (q >= p) break;
        const auto [a, b] = ends(all[p]);
        const auto [c, d] = ends(all[q]);
        if (a == c || a == d || b == c || b == d || !cross_inside(lines[p], lines[q], crossing)) continue;
        const int number = static_cast<int>(places_.size());
        places_.push_back({crossing});
        joined_with_.push_back(number);
        for (const int piece : {p, q})
          insertions.push_back({all[piece].line, all[piece].from, position(crossing, lines[piece]), number});
      }
    insert(insertions);
    return !insertions.empty();
  }

  JoinedLines result() {
    JoinedLines joined;
    for (const Place& place : places_) {
      joined.places.push_back(place.at);
      joined.has_moved.push_back(place.has_moved ? 1 : 0);
    }
    joined.lines = lines_;
    joined.lines.pop_back();
    return joined;
  }

  const double reach_, same_;
  std::vector<Place> places_;
  std::vector<int> joined_with_;  ///< per place itself, or another one that it has become
  std::map<std::pair<double, double>, int> known_;
  std::vector<JoinedLine> lines_;
  std::vector<char> is_closed_;
};

}  // namespace

JoinedLines join_lines(const Box& box, const std::vector<LineToJoin>& lines, double reach, double same) {
  return Joiner(box, lines, reach, same).join();
}

}  // namespace sprekk
