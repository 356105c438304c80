#include "components/fine_fracture/fine_level/fine_domain.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <stdexcept>

#include "components/fine_fracture/growth/arc.hpp"
#include "framework/mesh/plane/planar.hpp"

namespace sprekk::fine_fracture {

namespace {
constexpr double least_bend = 1e-10;  ///< 1 − cos of it, 1e-5 rad: rounding of directions leaves less
constexpr double same_place = 1e-10;  ///< of the rock's extent: ends of fractures that meet
constexpr double rounding = 1e-9;     ///< of a domain, or of a segment: what lies in it by less does not
}  // namespace

FracturePath fracture_path(const Mesh& mesh, int fracture, const TipPath& added_first, const TipPath& added_last,
                           const LastSegment& at_first, const LastSegment& at_last) {
  FracturePath path;
  const Fracture& cells = mesh.fractures[fracture];
  std::vector<char> is_kept;  // where the coarse level begins or ends, and where fractures meet
  const auto append = [&](const Point& x, double arc, bool keep) {
    const std::size_t n = path.points.size();
    if (n >= 2) {
      // On a straight part, the new point replaces the point before.
      const Point a = path.points[n - 1] - path.points[n - 2], b = x - path.points[n - 1];
      if (a.dot(b) > (1 - least_bend) * a.norm() * b.norm() && !is_kept.back()) {
        path.points.pop_back();
        path.arc.pop_back();
        is_kept.pop_back();
      }
    }
    path.points.push_back(x);
    path.arc.push_back(arc);
    is_kept.push_back(keep);
  };
  path.length = 0;
  for (int i = 0; i < cells.cell_count; ++i) path.length += mesh.fracture_cells[cells.first_cell + i].measure;
  const auto end_point = [&](bool at_end) -> const Ridge& {
    const FractureCell& cell = mesh.fracture_cells[cells.first_cell + (at_end ? cells.cell_count - 1 : 0)];
    return mesh.ridges[cell.ridges[at_end ? 1 : 0]];
  };
  double arc = 0;
  Point last = end_point(false).center;
  for (const Point& x : added_first.added) {
    arc -= (x - last).norm();
    last = x;
  }
  for (auto x = added_first.added.rbegin(); x != added_first.added.rend(); ++x) {
    append(*x, arc, false);
    const Point& next = x + 1 == added_first.added.rend() ? end_point(false).center : *(x + 1);
    arc += (*x - next).norm();
  }
  arc = 0;
  append(end_point(false).center, 0, true);
  for (int i = 0; i < cells.cell_count; ++i) {
    const FractureCell& cell = mesh.fracture_cells[cells.first_cell + i];
    const bool is_first = i == 0, is_last = i + 1 == cells.cell_count;
    if (is_last && at_last.turns) is_kept.back() = true;
    if (is_first && at_first.corner) append(*at_first.corner, arc + (1 - place_of_corner) * cell.measure, true);
    if (is_last && at_last.corner) append(*at_last.corner, arc + place_of_corner * cell.measure, true);
    arc += cell.measure;
    const Ridge& point = mesh.ridges[cell.ridges[1]];
    append(point.center, is_last ? path.length : arc,
           is_last || (is_first && at_first.turns) || point.kind == Ridge::Kind::junction);
  }
  arc = path.length;
  last = end_point(true).center;
  for (const Point& x : added_last.added) {
    arc += (x - last).norm();
    append(x, arc, false);
    last = x;
  }
  path.first_is_tip = end_point(false).kind == Ridge::Kind::tip;
  path.last_is_tip = end_point(true).kind == Ridge::Kind::tip;
  return path;
}

namespace {

struct Rectangle {
  Point low, high;
  double depth(const Point& x) const { return std::min((x - low).minCoeff(), (high - x).minCoeff()); }
};

Rectangle bounds(const Mesh& mesh) {
  Rectangle box{mesh.nodes[0], mesh.nodes[0]};
  for (const Point& x : mesh.nodes) {
    box.low = box.low.cwiseMin(x);
    box.high = box.high.cwiseMax(x);
  }
  return box;
}

/// The parameters at which the part of the segment inside of the box begins and ends; there is no such part if the
/// first is not below the second.
std::pair<double, double> clipped(const Rectangle& box, const Point& from, const Point& to) {
  double first = 0, last = 1;
  for (int k = 0; k < dimension; ++k) {
    const double d = to[k] - from[k];
    if (d == 0) {
      if (from[k] < box.low[k] || from[k] > box.high[k]) return {1, 0};
      continue;
    }
    const double a = (box.low[k] - from[k]) / d, b = (box.high[k] - from[k]) / d;
    first = std::max(first, std::min(a, b));
    last = std::min(last, std::max(a, b));
  }
  return {first, last};
}

/// The sides of the rock that are not on those of its bounding box.
std::vector<Segment> sides_within(const Mesh& mesh, const Rectangle& bounds) {
  const double near = rounding * (bounds.high - bounds.low).maxCoeff();
  std::vector<Segment> sides;
  for (int face = 0; face < mesh.face_count(); ++face) {
    if (mesh.face_cells[face][1] != none || mesh.face_fracture_cell[face] != none) continue;
    const Segment side{mesh.nodes[mesh.face_nodes[face][0]], mesh.nodes[mesh.face_nodes[face][1]]};
    if (bounds.depth(0.5 * (side.from + side.to)) > near) sides.push_back(side);
  }
  return sides;
}

/// Whether none of the sides enters the box.
bool is_in_rock(const Rectangle& box, const std::vector<Segment>& sides) {
  const Point inwards = rounding * (box.high - box.low);
  const Rectangle inside{box.low + inwards, box.high - inwards};
  return std::ranges::none_of(sides, [&](const Segment& side) {
    const auto [first, last] = clipped(inside, side.from, side.to);
    return first < last;
  });
}

/// Moves a point that is near the outline exactly onto it.
Point snapped(const Rectangle& box, Point x) {
  const double near = rounding * (box.high - box.low).maxCoeff();
  for (int k = 0; k < dimension; ++k) {
    if (std::abs(x[k] - box.low[k]) < near) x[k] = box.low[k];
    if (std::abs(x[k] - box.high[k]) < near) x[k] = box.high[k];
  }
  return x;
}

/// A place from which the outline keeps away.
struct Avoided {
  Point position;  ///< m
  double share;    ///< the distance that the outline keeps from here, over that which it keeps from a tip
};

/// All ends, junctions and bends. Displacements of the coarse level vary within a cell on both sides of a sharp kink;
/// beside a slight bend they hardly do. The coarse level does not know the bends of added paths.
std::vector<Avoided> avoided_places(const std::vector<FracturePath>& paths) {
  constexpr double at_kink = 4, at_least = 0.25;  // cells at the tip: from a sharp kink, and from the slightest bend
  constexpr double sharp = 0.5;                   // the sine of a bend
  const auto is_junction = [&paths](const FracturePath& of, const Point& x) {
    return std::ranges::any_of(
        paths, [&](const FracturePath& other) { return &other != &of && std::ranges::count(other.points, x) > 0; });
  };
  std::vector<Avoided> places;
  for (const FracturePath& path : paths)
    for (std::size_t i = 0; i < path.points.size(); ++i) {
      const Point& x = path.points[i];
      double share = 1;
      if (path.arc[i] > 0 && path.arc[i] < path.length) {
        const Point before = (x - path.points[i - 1]).normalized(), after = (path.points[i + 1] - x).normalized();
        const double bend = before.dot(after) > 0 ? std::abs(cross(before, after)) : 1;
        share = std::clamp(at_kink * bend / sharp, is_junction(path, x) ? 1 : at_least, at_kink);
      }
      places.push_back({x, share});
    }
  return places;
}

/// The smallest distance of the outline from places inside of the rock, over their share, and from segments along one
/// of its sides. For a segment the distance of its farthest point counts, so that segments that cross a side are left
/// out. Points on the outer boundary of the rock are left out, too.
double smallest_gap(const Rectangle& box, const Rectangle& rock, const std::vector<FracturePath>& paths,
                    const std::vector<Avoided>& places) {
  double gap = std::numeric_limits<double>::infinity();
  for (const auto& [x, share] : places)
    for (int k = 0; k < dimension; ++k) {
      // Beyond the ends of the sides normal to axis k.
      const double beside = std::max({box.low[1 - k] - x[1 - k], x[1 - k] - box.high[1 - k], 0.0});
      if (box.low[k] > rock.low[k]) gap = std::min(gap, std::max(beside, std::abs(x[k] - box.low[k])) / share);
      if (box.high[k] < rock.high[k]) gap = std::min(gap, std::max(beside, std::abs(x[k] - box.high[k])) / share);
    }
  for (const FracturePath& path : paths)
    for (std::size_t i = 0; i + 1 < path.points.size(); ++i)
      for (int k = 0; k < dimension; ++k) {
        // The parts of the rock beyond the two sides normal to axis k.
        Rectangle strip = rock;
        strip.low[1 - k] = box.low[1 - k];
        strip.high[1 - k] = box.high[1 - k];
        const Point &a = path.points[i], &b = path.points[i + 1];
        const auto [first, last] = clipped(strip, a, b);
        if (last - first <= rounding) continue;
        const double from = a[k] + first * (b[k] - a[k]), to = a[k] + last * (b[k] - a[k]);
        const auto farthest = [&](double side) { return std::max(std::abs(from - side), std::abs(to - side)); };
        if (box.low[k] > rock.low[k]) gap = std::min(gap, farthest(box.low[k]));
        if (box.high[k] < rock.high[k]) gap = std::min(gap, farthest(box.high[k]));
      }
  return gap;
}

/// Adds x to the points of the path if the path leads through x; returns whether it does.
bool add_if_on(FracturePath& path, const Point& x, double tolerance) {
  for (std::size_t i = 0; i + 1 < path.points.size(); ++i) {
    const Segment segment{path.points[i], path.points[i + 1]};
    if (distance(x, segment) > tolerance) continue;
    if (x == segment.from || x == segment.to) return true;
    const double arc = path.arc[i] + (x - segment.from).norm();
    path.points.insert(path.points.begin() + i + 1, x);
    path.arc.insert(path.arc.begin() + i + 1, arc);
    return true;
  }
  return false;
}

/// The added path of an end may reach another fracture, at a point of its mesh, before the coarse level has the path.
/// Then the end is no tip any more, and both paths have a point there.
std::vector<FracturePath> joined(std::vector<FracturePath> paths, double tolerance) {
  for (std::size_t i = 0; i < paths.size(); ++i)
    for (const bool at_end : {false, true}) {
      bool& is_tip = at_end ? paths[i].last_is_tip : paths[i].first_is_tip;
      if (!is_tip || (at_end ? paths[i].arc.back() <= paths[i].length : paths[i].arc.front() >= 0)) continue;
      const Point end = at_end ? paths[i].points.back() : paths[i].points.front();
      for (std::size_t k = 0; k < paths.size(); ++k)
        if (k != i && add_if_on(paths[k], end, tolerance)) is_tip = false;
    }
  return paths;
}

/// The square around the center, larger by small steps until no side is near to a fracture, and smaller where it would
/// leave the rock, of which these sides are not on its bounding box.
Rectangle square_in_rock(const Rectangle& rock, const std::vector<Segment>& sides, const Point& center, double size,
                         double gap, const std::vector<FracturePath>& paths) {
  constexpr double step = 0.02;      // of the size: how finely sizes are tried
  constexpr double more = 1 + 1e-9;  // exceeds rounding, so that domains of mirrored scenes are mirrored
  const std::vector<Avoided> places = avoided_places(paths);
  Rectangle box;
  double widest = -1;
  const auto try_factor = [&](double factor) {
    const Point half = Point::Constant(0.5 * factor * size);
    const Rectangle other{(center - half).cwiseMax(rock.low), (center + half).cwiseMin(rock.high)};
    if (!is_in_rock(other, sides)) return false;
    const double found = smallest_gap(other, rock, paths, places);
    if (found <= widest * more) return true;
    widest = found;
    box = other;
    return true;
  };
  for (double factor = 1; factor < largest_enlargement && widest * more < gap; factor += step)
    if (!try_factor(factor)) break;
  if (widest >= 0) return box;
  for (double factor = 1 - step; factor > 0.5 * step && widest * more < gap; factor -= step) try_factor(factor);
  if (widest < 0)
    throw std::invalid_argument(fmt::format(
        "the square of a tip at ({:.4g} m, {:.4g} m) does not fit into the rock; the tip is too near to a side",
        center[0], center[1]));
  return box;
}

}  // namespace

FineDomain fine_domain(const Mesh& mesh, const std::vector<FracturePath>& separate_paths, const TipEnd& tip,
                       const Point& center, double size, double gap, CrackPath::Walls coarse_walls,
                       const std::vector<Point>* outline) {
  const Rectangle rock = bounds(mesh);
  const std::vector<FracturePath> paths = joined(separate_paths, same_place * (rock.high - rock.low).maxCoeff());
  const Rectangle box = outline ? Rectangle{(*outline)[0], (*outline)[2]}
                                : square_in_rock(rock, sides_within(mesh, rock), center, size, gap, paths);
  FineDomain domain;
  domain.geometry.outline = {box.low, {box.high[0], box.low[1]}, box.high, {box.low[0], box.high[1]}};
  for (int f = 0; f < static_cast<int>(paths.size()); ++f) {
    const FracturePath& path = paths[f];
    bool is_open = false;  // whether the last crack continues
    for (std::size_t i = 0; i + 1 < path.points.size(); ++i) {
      const Point &a = path.points[i], &b = path.points[i + 1];
      const auto [first, last] = clipped(box, a, b);
      if (last - first <= rounding) {
        is_open = false;
        continue;
      }
      const auto at = [&](double t) { return snapped(box, t == 0 ? a : t == 1 ? b : Point(a + t * (b - a))); };
      const auto arc = [&](double t) { return path.arc[i] + t * (path.arc[i + 1] - path.arc[i]); };
      if (!is_open || first > 0) {
        domain.geometry.cracks.push_back({{at(first)}, i == 0 && first == 0 && path.first_is_tip, false, {}});
        domain.sources.push_back({f, {arc(first)}});
        if (f == tip.fracture && !tip.at_end && i == 0 && first == 0) {
          domain.crack = static_cast<int>(domain.sources.size()) - 1;
          domain.is_last = false;
        }
      }
      CrackPath& crack = domain.geometry.cracks.back();
      crack.points.push_back(at(last));
      const double middle = 0.5 * (arc(first) + arc(last));
      crack.walls.push_back(middle < 0 || middle > path.length ? CrackPath::Walls::traction : coarse_walls);
      domain.sources.back().arc.push_back(arc(last));
      is_open = last == 1;
      if (i + 2 == path.points.size() && last == 1) {
        crack.last_is_tip = path.last_is_tip;
        if (f == tip.fracture && tip.at_end) domain.crack = static_cast<int>(domain.sources.size()) - 1;
      }
    }
  }
  if (domain.crack == none) throw std::runtime_error("the domain of a tip does not contain the tip");
  return domain;
}

double reach_in_rock(const Mesh& mesh, const std::vector<Point>& outline, const Point& center) {
  const Rectangle rock = bounds(mesh);
  const Point near = rounding * (rock.high - rock.low);
  double reach = std::numeric_limits<double>::infinity();
  for (int k = 0; k < dimension; ++k) {
    if (outline[0][k] > rock.low[k] + near[k]) reach = std::min(reach, center[k] - outline[0][k]);
    if (outline[2][k] < rock.high[k] - near[k]) reach = std::min(reach, outline[2][k] - center[k]);
  }
  return reach;
}

void add_beyond(FineDomain& domain, const std::vector<FracturePath>& paths) {
  const std::vector<Point>& outline = domain.geometry.outline;
  const Rectangle inner{outline[0], outline[2]};
  const Point reach = Point::Constant((inner.high - inner.low).maxCoeff());
  const Rectangle outer{inner.low - reach, inner.high + reach};
  std::vector<std::vector<Point>>& pieces = domain.geometry.beyond;
  pieces.clear();
  domain.beyond.clear();
  for (int f = 0; f < static_cast<int>(paths.size()); ++f) {
    const FracturePath& path = paths[f];
    bool is_open = false;  // whether the last piece continues
    for (std::size_t i = 0; i + 1 < path.points.size(); ++i) {
      const Point &a = path.points[i], &b = path.points[i + 1];
      const auto [begin, end] = clipped(outer, a, b);
      if (end - begin <= rounding) {
        is_open = false;
        continue;
      }
      auto [enters, leaves] = clipped(inner, a, b);
      if (leaves - enters <= rounding) enters = leaves = end;
      for (const auto& [first, last] : {std::pair(begin, enters), std::pair(leaves, end)}) {
        if (last - first > rounding) {
          const auto at = [&](double t) { return snapped(inner, Point(a + t * (b - a))); };
          const auto arc = [&](double t) { return path.arc[i] + t * (path.arc[i + 1] - path.arc[i]); };
          if (!is_open || first > 0) {
            pieces.push_back({at(first)});
            domain.beyond.push_back({f, {arc(first)}});
          }
          pieces.back().push_back(at(last));
          domain.beyond.back().arc.push_back(arc(last));
          is_open = last == 1;
        } else {
          is_open = false;
        }
      }
    }
    const double near = rounding * reach.maxCoeff();
    const auto ends_on_outline = [&](const Point& x) { return std::abs(inner.depth(x)) < near; };
    const std::size_t last = path.points.size() - 1;
    if (!path.first_is_tip && ends_on_outline(path.points[0])) {
      const Point& x = path.points[0];
      pieces.push_back({x + reach[0] * (x - path.points[1]).normalized(), x});
      domain.beyond.push_back({f, {path.arc[0], path.arc[0]}});
    }
    if (!path.last_is_tip && ends_on_outline(path.points[last])) {
      const Point& x = path.points[last];
      pieces.push_back({x, x + reach[0] * (x - path.points[last - 1]).normalized()});
      domain.beyond.push_back({f, {path.arc[last], path.arc[last]}});
    }
  }
}

}  // namespace sprekk::fine_fracture
