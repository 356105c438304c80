#include "framework/meshing/joining/snap_geometry.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <set>
#include <utility>

#include "framework/mesh/mesh.hpp"
#include "framework/mesh/plane/planar.hpp"
#include "framework/meshing/joining/plane/drop_short_segments.hpp"
#include "framework/meshing/joining/plane/join_lines.hpp"

namespace sprekk {
namespace {

/// Points that are one although their coordinates differ, of the distance at which points are one in a mesh: far below
/// it, so that what is joined stays so.
constexpr double round_off = 1e-3;

bool is_sound(const Geometry& geometry) {
  const Box& box = geometry.box;
  if (geometry.is_imported() || !box.low.allFinite() || !box.high.allFinite() || box.size().minCoeff() <= 0)
    return false;
  const auto are_finite = [](const std::vector<Point>& points, std::size_t least) {
    return points.size() >= least && std::ranges::all_of(points, [](const Point& x) { return x.allFinite(); });
  };
  return std::ranges::all_of(geometry.fractures, [&](const auto& f) { return are_finite(f.points, 2); }) &&
         std::ranges::all_of(geometry.regions, [&](const auto& r) { return are_finite(r.polygon, 3); });
}

double length_of(const std::vector<Point>& points) {
  double length = 0;
  for (std::size_t i = 0; i + 1 < points.size(); ++i) length += (points[i + 1] - points[i]).norm();
  return length;
}

double extent_of(const std::vector<Point>& points) {
  double extent = 0;
  for (const Point& point : points) extent = std::max(extent, (point - points.front()).norm());
  return extent;
}

class Snapper {
 public:
  Snapper(Geometry& geometry, const MeshOptions& options)
      : geometry_(geometry),
        tolerance_(point_tolerance(geometry.box)),
        same_(round_off * tolerance_),
        reach_(snap_length(geometry, options)),
        shortest_(shortest_size(geometry, options)),
        is_default_(!geometry.snap) {}

  std::vector<std::string> snap() {
    if (!(reach_ > tolerance_)) return {};
    if (!geometry_.fractures.empty() && reach_ > shortest_)
      throw InputError(
          geometry_.snap_origin, fmt::format("lines {:.3g} m apart would be joined", reach_),
          fmt::format("the shortest cells are asked to be {:.3g} m long, and would show nothing of it", shortest_),
          "lower geometry.snap");
    leave_out_specks();
    for (FractureGeometry& fracture : geometry_.fractures) thin_out(fracture.points, false);
    for (RegionGeometry& region : geometry_.regions) thin_out(region.polygon, true);
    std::vector<LineToJoin> lines;
    for (const FractureGeometry& fracture : geometry_.fractures) lines.push_back({fracture.points});
    for (const RegionGeometry& region : geometry_.regions) lines.push_back({region.polygon, true});
    joined_ = join_lines(geometry_.box, lines, reach_, same_);
    find_owners();
    take_fractures();
    take_regions();
    geometry_.snap = reach_;
    return notes();
  }

 private:
  using Step = std::pair<int, int>;  ///< its two places, the smaller number first

  /// Points at one place are not left out here: a fracture without a length is a slip.
  void leave_out_specks() {
    std::erase_if(geometry_.fractures, [&](const FractureGeometry& fracture) {
      const double extent = extent_of(fracture.points);
      if (extent < tolerance_ || extent >= reach_) return false;
      specks_.push_back(fracture.name);
      return true;
    });
  }

  void thin_out(std::vector<Point>& points, bool is_closed) {
    const std::vector<int> kept = without_short_segments(points, reach_, is_closed);
    if (kept.size() == points.size() || kept.size() < (is_closed ? 3U : 2U) || extent_of(points) < tolerance_) return;
    thinned_ += static_cast<int>(points.size() - kept.size());
    std::vector<Point> fewer;
    for (const int i : kept) fewer.push_back(points[i]);
    points = std::move(fewer);
  }

  std::vector<Step> steps_of(std::size_t fracture) const {
    const std::vector<int>& places = joined_.lines[fracture].places;
    std::vector<Step> steps;
    for (std::size_t i = 0; i + 1 < places.size(); ++i) steps.push_back(std::minmax(places[i], places[i + 1]));
    return steps;
  }

  /// Of each step the longest fracture that takes it; of those as long within the tolerance the first by name.
  void find_owners() {
    std::vector<std::size_t> order;
    std::vector<double> lengths;  // in tolerances
    for (std::size_t f = 0; f < geometry_.fractures.size(); ++f) {
      order.push_back(f);
      lengths.push_back(std::round(length_of(geometry_.fractures[f].points) / tolerance_));
    }
    std::ranges::stable_sort(order, [&](std::size_t a, std::size_t b) {
      if (lengths[a] != lengths[b]) return lengths[a] > lengths[b];
      return geometry_.fractures[a].name < geometry_.fractures[b].name;
    });
    for (const std::size_t f : order)
      for (const Step& step : steps_of(f)) owner_.emplace(step, f);
  }

  void take_fractures() {
    std::set<std::string> names;
    for (const FractureGeometry& fracture : geometry_.fractures) names.insert(fracture.name);
    std::vector<FractureGeometry> taken;
    for (std::size_t f = 0; f < geometry_.fractures.size(); ++f) {
      const FractureGeometry& given = geometry_.fractures[f];
      if (extent_of(given.points) < tolerance_) {
        taken.push_back(given);
        continue;
      }
      std::vector<std::vector<Point>> parts = parts_of(f);
      if (parts.empty()) doubles_.push_back(given.name);
      // The longest part keeps the name.
      const auto longest = std::ranges::max_element(parts, {}, length_of);
      for (auto part = parts.begin(); part != parts.end(); ++part) {
        FractureGeometry fracture = given;
        fracture.points = std::move(*part);
        if (part != longest) {
          fracture.name = free_name(given.name, names);
          divided_.push_back(fracture.name);
        }
        taken.push_back(std::move(fracture));
      }
    }
    geometry_.fractures = std::move(taken);
  }

  static std::string free_name(const std::string& name, std::set<std::string>& names) {
    for (int number = 2;; ++number)
      if (std::string free = fmt::format("{}_{}", name, number); names.insert(free).second) return free;
  }

  /// What a fracture keeps: the points of each run of steps that are its own.
  std::vector<std::vector<Point>> parts_of(std::size_t f) {
    const JoinedLine& line = joined_.lines[f];
    const std::vector<Step> steps = steps_of(f);
    std::vector<std::vector<Point>> parts;
    for (std::size_t i = 0; i < steps.size();) {
      std::size_t end = i;
      while (end < steps.size() && owner_.at(steps[end]) == f) ++end;
      if (end > i) parts.push_back(points_between(line, i, end, geometry_.fractures[f].points));
      for (; end < steps.size() && owner_.at(steps[end]) != f; ++end) {
        shared_length_ += (joined_.places[steps[end].first] - joined_.places[steps[end].second]).norm();
        if (std::exchange(last_shared_, f) != f) ++shared_;
      }
      i = end;
    }
    return parts;
  }

  /// The points along a joined line from one of its places to another one: the given ones, and others only where the
  /// line is not straight between the given ones.
  std::vector<Point> points_between(const JoinedLine& line, std::size_t from, std::size_t to,
                                    const std::vector<Point>& given) {
    const auto at = [&](std::size_t i) -> Point {
      const int place = line.places[i];
      if (line.points[i] == none) return joined_.places[place];
      const Point& original = given[line.points[i]];
      return (joined_.places[place] - original).norm() < same_ ? original : joined_.places[place];
    };
    std::vector<Point> points = {at(from)};
    for (std::size_t i = from; i < to;) {
      std::size_t next = i + 1;
      while (next < to && line.points[next] == none) ++next;
      const Segment straight{at(i), at(next)};
      bool is_straight = true;
      for (std::size_t k = i + 1; k < next; ++k)
        is_straight = is_straight && distance(joined_.places[line.places[k]], straight) < same_;
      for (std::size_t k = i + 1; k < next && !is_straight; ++k) points.push_back(at(k));
      points.push_back(at(next));
      i = next;
    }
    for (std::size_t i = from; i <= to; ++i)
      if (line.points[i] != none) note_move(given[line.points[i]], at(i));
    return points;
  }

  void note_move(const Point& from, const Point& to) {
    if (from == to) return;
    ++moved_;
    const double way = (to - from).norm();
    if (way <= farthest_) return;
    farthest_ = way;
    farthest_at_ = to;
  }

  void take_regions() {
    for (std::size_t r = 0; r < geometry_.regions.size(); ++r) {
      RegionGeometry& region = geometry_.regions[r];
      const JoinedLine& line = joined_.lines[joined_.lines.size() - geometry_.regions.size() + r];
      std::vector<Point> polygon;
      if (line.places.size() > 3) polygon = points_between(line, 0, line.places.size() - 1, region.polygon);
      if (polygon.size() > 1) polygon.pop_back();  // the first point again
      if (polygon.size() < 3)
        throw InputError(region.origin, "region '" + region.name + "' vanishes",
                         fmt::format("what is nearer than {:.3g} m is joined", reach_),
                         "lower geometry.snap, or leave the region out");
      region.polygon = std::move(polygon);
    }
  }

  std::string some(const std::vector<std::string>& names) const {
    constexpr std::size_t most_names = 5;  // a line of text
    std::string text;
    for (std::size_t i = 0; i < std::min(names.size(), most_names); ++i)
      text += (i == 0 ? "'" : ", '") + names[i] + "'";
    return text + (names.size() > most_names ? fmt::format(", … ({} in all)", names.size()) : "");
  }

  std::vector<std::string> notes() const {
    const auto counted = [](int count, const char* what) {
      return fmt::format("{} {}{}", count, what, count == 1 ? "" : "s");
    };
    std::vector<std::string> done;
    if (moved_ > 0)
      done.push_back(fmt::format("{} moved onto a point, a line or a side nearby, by up to {:.2g} m at {}",
                                 counted(moved_, "point"), farthest_, to_text(farthest_at_)));
    if (thinned_ > 0)
      done.push_back(fmt::format("{} of lines with shorter steps left out", counted(thinned_, "point")));
    if (shared_ > 0)
      done.push_back(
          fmt::format("{:.3g} m of {} left out that lay on others", shared_length_, counted(shared_, "fracture")));
    if (!doubles_.empty()) done.push_back("of " + some(doubles_) + " nothing is left");
    if (!divided_.empty()) done.push_back("which divides fractures: " + some(divided_) + " are new");
    if (!specks_.empty()) done.push_back("fractures that are shorter were left out: " + some(specks_));
    std::vector<std::string> notes;
    if (done.empty()) return notes;
    std::string text = fmt::format("lines nearer than {:.3g} m were joined: ", reach_);
    for (std::size_t i = 0; i < done.size(); ++i) text += (i == 0 ? "" : "; ") + done[i];
    notes.push_back(
        text + (is_default_ ? " (by default a hundredth of the shortest cell at a fracture)" : " (geometry.snap)") +
        " give geometry.snap another length to join more or less");
    return notes;
  }

  Geometry& geometry_;
  const double tolerance_, same_, reach_, shortest_;
  const bool is_default_;
  JoinedLines joined_;
  std::map<Step, std::size_t> owner_;
  int moved_ = 0, thinned_ = 0, shared_ = 0;
  std::size_t last_shared_ = static_cast<std::size_t>(none);
  double farthest_ = 0, shared_length_ = 0;
  Point farthest_at_ = Point::Zero();
  std::vector<std::string> specks_, doubles_, divided_;
};

}  // namespace

std::vector<std::string> snap_geometry(Geometry& geometry, const MeshOptions& options) {
  if (!is_sound(geometry)) return {};
  return Snapper(geometry, options).snap();
}

}  // namespace sprekk
