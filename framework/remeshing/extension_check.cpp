#include "framework/remeshing/extension_check.hpp"

#include <algorithm>
#include <cmath>
#include <optional>
#include <sstream>
#include <tuple>

#include "framework/mesh/plane/planar.hpp"
#include "framework/remeshing/healed_mesh.hpp"
#include "framework/remeshing/obstacles.hpp"

namespace sprekk {
namespace {

using Reason = ExtensionError::Reason;

/// A path approaches a segment if the distance of the path falls below this part of the distance of its beginning.
constexpr double approach = 0.9;
/// What rounding leaves of a length, or of the cosine of 90 degrees.
constexpr double rounding = 1e-12;
/// Of an edge: a shorter segment of a path has no direction.
constexpr double shortest = 1e-6;
/// Factor on the least gap where a tip looks ahead: it asks for more room than the check of its next path will.
constexpr double room_ahead = 1.5;
/// Two parts of one path must be farther from each other than this part of their distance along the path.
constexpr double self_gap = 0.25;

struct OwnEnd {
  Ridge::Kind kind;
  Point center, before;
};

OwnEnd own_end(const Mesh& mesh, int fracture, bool at_end) {
  const auto& [name, first, count] = mesh.fractures[fracture];
  const FractureCell& cell = mesh.fracture_cells[at_end ? first + count - 1 : first];
  const Ridge& point = mesh.ridges[cell.ridges[at_end ? 1 : 0]];
  return {point.kind, point.center, mesh.ridges[cell.ridges[at_end ? 0 : 1]].center};
}

double extent(const Mesh& mesh) {
  Point low = mesh.nodes.front(), high = low;
  for (const Point& x : mesh.nodes) low = low.cwiseMin(x), high = high.cwiseMax(x);
  return (high - low).norm();
}

/// The point of `path` nearest to `other`, or their crossing.
Point meeting_point(const Segment& path, const Segment& other) {
  Point crossing;
  if (cross_inside(path, other, crossing)) return crossing;
  const double from = distance(path.from, other), to = distance(path.to, other);
  const double a = distance(other.from, path), b = distance(other.to, path);
  if (std::min(from, to) <= std::min(a, b)) return from <= to ? path.from : path.to;
  return a <= b ? other.from : other.to;
}

/// Whether a part of a path leads away from a straight line that is near to the path's beginning.
bool leads_away(const Segment& step, const Point& beginning, const Segment& line) {
  return distance(step.to, line) - distance(step.from, line) >= std::sin(least_incidence) * step.length() &&
         distance(step, line) >= approach * distance(beginning, line);
}

class Check {
 public:
  Check(const Mesh& mesh, const std::vector<PathExtension>& extensions, double size)
      : mesh_(mesh), size_(size), touch_(rounding * extent(mesh)), extensions_(extensions) {}

  std::vector<PathExtension> run() {
    for (index_ = 0; index_ < static_cast<int>(extensions_.size()); ++index_) {
      const int fracture = extensions_[index_].fracture;
      std::vector<Point>& points = extensions_[index_].points;
      if (fracture < 0 || fracture >= static_cast<int>(mesh_.fractures.size())) {
        throw std::invalid_argument("extension of fracture " + std::to_string(fracture) + ", which does not exist");
      }
      check_end();
      check_form();
      is_joined_.assign(mesh_.fractures.size(), false);
      const bool ends_on_boundary = snap(points.back());
      if (!ends_on_boundary) join(points.back());
      paths_.push_back(path());
      check_boundary(ends_on_boundary);
      check_fractures();
      check_itself();
      for (int other = 0; other < index_; ++other) check_other(other);
      refuse_obstacle();
    }
    return extensions_;
  }

 private:
  [[noreturn]] void refuse(Reason reason, const Point& where, const std::string& problem,
                           const std::string& why) const {
    throw ExtensionError(reason, index_, where,
                         "fracture '" + mesh_.fractures[extensions_[index_].fracture].name +
                             "' cannot be extended: it " + problem + " at " + to_text(where) + " (" + why + ")");
  }

  void check_end() const {
    const PathExtension& own = extensions_[index_];
    const OwnEnd end = own_end(mesh_, own.fracture, own.at_end);
    if (end.kind != Ridge::Kind::tip) {
      refuse(Reason::no_tip, end.center, "already ends",
             end.kind == Ridge::Kind::junction ? "at another fracture" : "on the outer boundary");
    }
    for (int i = 0; i < index_; ++i) {
      if (extensions_[i].fracture == own.fracture && extensions_[i].at_end == own.at_end) {
        refuse(Reason::no_tip, end.center, "is extended twice", "an end grows along one path at a time");
      }
    }
  }

  void check_form() const {
    const PathExtension& own = extensions_[index_];
    const OwnEnd end = own_end(mesh_, own.fracture, own.at_end);
    if (own.points.empty()) refuse(Reason::no_path, end.center, "gets no new point", "the path is empty");
    Point from = end.center, before = end.before;
    for (const Point& to : own.points) {
      if (!to.allFinite()) refuse(Reason::no_path, from, "gets a point that is no number", "after this one");
      if ((to - from).norm() <= std::max(touch_, shortest * size_)) {
        refuse(Reason::no_path, from, "gets a segment without length", "two points of the path are one");
      }
      if ((to - from).dot(from - before) < -rounding * (to - from).norm() * (from - before).norm()) {
        refuse(Reason::turns_back, from, "turns back", "by more than 90 degrees");
      }
      before = from;
      from = to;
    }
  }

  /// Moves an end onto the outer boundary if it is nearer than boundary_snap.
  bool snap(Point& end) const {
    double least = boundary_snap * size_;
    Point nearest = end;
    for (int face = 0; face < mesh_.face_count(); ++face) {
      if (mesh_.face_side[face] == none) continue;
      const Segment s = face_segment(mesh_, face);
      if (distance(end, s) >= least) continue;
      least = distance(end, s);
      const Point along = s.to - s.from;
      const double t = (end - s.from).dot(along) / along.squaredNorm();
      // On a side parallel to an axis, the end gets the exact coordinate of the side.
      nearest = t <= 0 ? s.from : t >= 1 ? s.to : Point(s.from + t * along);
      for (int axis = 0; axis < 2; ++axis) {
        if (s.from[axis] == s.to[axis]) nearest[axis] = s.from[axis];
      }
    }
    const bool is_near = least < boundary_snap * size_;
    if (is_near) end = nearest;
    return is_near;
  }

  /// Moves an end onto a ridge of other fractures if it is nearer than joint_snap, and marks these fractures
  /// as joined.
  void join(Point& end) {
    const int own = extensions_[index_].fracture;
    double least = joint_snap * size_;
    const Ridge* nearest = nullptr;
    for (const Ridge& point : mesh_.ridges) {
      const bool is_own = std::any_of(point.cells.begin(), point.cells.end(),
                                      [&](int cell) { return mesh_.fracture_cells[cell].fracture == own; });
      if (is_own || point.kind == Ridge::Kind::on_boundary || (point.center - end).norm() >= least) continue;
      least = (point.center - end).norm();
      nearest = &point;
    }
    if (!nearest) return;
    end = nearest->center;
    for (const Ridge& point : mesh_.ridges) {
      if (point.center != end) continue;
      for (const int cell : point.cells) is_joined_[mesh_.fracture_cells[cell].fracture] = true;
    }
  }

  /// Whether a fracture cell begins where the path ends. Throws ExtensionError if the angle between the two is small.
  bool is_joint(const Segment& path, const Segment& cell, const std::string& name) const {
    if (path.to != cell.from && path.to != cell.to) return false;
    const Point back = path.from - path.to, along = cell.from + cell.to - 2 * path.to;
    if (std::atan2(std::abs(cross(back, along)), back.dot(along)) < least_incidence)
      refuse(Reason::too_near, path.to, "runs along " + name, "it would meet it at less than 15 degrees");
    return true;
  }

  std::vector<Segment> path() const {
    const PathExtension& own = extensions_[index_];
    std::vector<Segment> segments;
    Point from = own_end(mesh_, own.fracture, own.at_end).center;
    for (const Point& to : own.points) {
      segments.push_back({from, to});
      from = to;
    }
    return segments;
  }

  /// The least distance that the path must keep from an object at this distance from the beginning of the path.
  double allowed(double distance_of_tip) const { return std::min(least_gap * size_, approach * distance_of_tip); }

  /// The same for a part of the same fracture; `way`: the distance from it along the fracture.
  double allowed_to_itself(double way) const { return std::min(least_gap * size_, self_gap * way); }

  void check_boundary(bool ends_on_boundary) {
    const auto& segments = paths_[index_];
    const Point tip = segments.front().from;
    for (std::size_t i = 0; i < segments.size(); ++i) {
      const Segment& s = segments[i];
      const bool is_ending = ends_on_boundary && i + 1 == segments.size();
      for (int face = 0; face < mesh_.face_count(); ++face) {
        if (mesh_.face_side[face] == none) continue;
        const Segment side = face_segment(mesh_, face);
        if (is_ending && distance(s.to, side) <= touch_) {
          const double sine = std::abs(cross(s.to - s.from, side.to - side.from)) / (s.length() * side.length());
          if (sine < std::sin(least_incidence)) {
            refuse(Reason::too_near, s.to, "runs along the outer boundary", "it would meet it at less than 15 degrees");
          }
          continue;
        }
        if (distance(s, side) < allowed(distance(tip, side)) && leads_away(s, tip, straight_side(mesh_, face)))
          continue;
        note(i, side, is_ending ? 0 : allowed(distance(tip, side)), Reason::leaves_mesh, "the outer boundary");
      }
    }
  }

  /// An obstacle of a path. Meeting an obstacle is worse than being near to one; of two equal cases the first counts.
  struct Obstacle {
    bool is_met;
    std::size_t segment;
    double way, gap;  ///< m, along the segment and between both
    Point where;
    Reason reason;
    std::string name;
  };

  void note(std::size_t segment, const Segment& other, double allowed_gap, Reason reason, const std::string& name) {
    const Segment& s = paths_[index_][segment];
    const double gap = distance(s, other);
    if (gap > touch_ && gap >= allowed_gap) return;
    const Point where = meeting_point(s, other);
    const Obstacle obstacle{gap <= touch_, segment, (where - s.from).norm(), gap, where, reason, name};
    const auto rank = [](const Obstacle& o) { return std::tuple(!o.is_met, o.segment, o.way); };
    if (!obstacle_ || rank(obstacle) < rank(*obstacle_)) obstacle_ = obstacle;
  }

  void refuse_obstacle() const {
    if (!obstacle_) return;
    const auto& [is_met, segment, way, gap, where, reason, name] = *obstacle_;
    if (!is_met) {
      std::ostringstream why;
      why << "at " << gap / size_ << " edge lengths, at least " << least_gap << " are needed";
      refuse(Reason::too_near, where, "passes too near to " + name, why.str());
    }
    if (reason == Reason::leaves_mesh) refuse(reason, where, "leaves the mesh", "a path may end on the outer boundary");
    refuse(reason, where, "meets " + name, "a path may end at a point of its mesh, and not cross it");
  }

  std::string name_of(int fracture) const { return "fracture '" + mesh_.fractures[fracture].name + "'"; }

  void check_fractures() {
    const PathExtension& own = extensions_[index_];
    const auto& segments = paths_[index_];
    const Point tip = segments.front().from;
    double way_ahead = 0;
    for (std::size_t i = 0; i < segments.size(); ++i) {
      for (int f = 0; f < static_cast<int>(mesh_.fractures.size()); ++f) {
        const auto& [name, first, count] = mesh_.fractures[f];
        double way_behind = 0;
        for (int n = 0; n < count; ++n) {
          // Backwards from the end that grows, to add up the distance along the fracture.
          const int cell = own.at_end ? first + count - 1 - n : first + n;
          const Segment other = cell_segment(mesh_, cell);
          const bool is_ending = is_joined_[f] && i + 1 == segments.size();
          if (is_ending) {
            if (!is_joint(segments[i], other, name_of(f))) note(i, other, 0, Reason::crosses_fracture, name_of(f));
          } else if (f != own.fracture) {
            if (distance(segments[i], other) < allowed(distance(tip, other)) &&
                leads_away(segments[i], tip, straight_part(mesh_, cell)))
              continue;
            note(i, other, allowed(distance(tip, other)), Reason::crosses_fracture, name_of(f));
          } else if (i > 0 || n > 0) {
            note(i, other, allowed_to_itself(way_ahead + way_behind), Reason::crosses_fracture, "itself");
          }
          way_behind += other.length();
        }
      }
      way_ahead += segments[i].length();
    }
  }

  void check_itself() {
    const auto& segments = paths_[index_];
    for (std::size_t i = 0; i < segments.size(); ++i) {
      double way = 0;
      for (std::size_t j = i; j-- > 0;) {
        if (j + 1 < i) note(i, segments[j], allowed_to_itself(way), Reason::crosses_fracture, "itself");
        way += segments[j].length();
      }
    }
  }

  void check_other(int other) {
    const double tips = (paths_[index_].front().from - paths_[other].front().from).norm();
    for (std::size_t i = 0; i < paths_[index_].size(); ++i) {
      for (const Segment& segment : paths_[other]) {
        note(i, segment, allowed(tips), Reason::crosses_fracture,
             "the extension of " + name_of(extensions_[other].fracture));
      }
    }
  }

  const Mesh& mesh_;
  const double size_;
  const double touch_;  ///< m; objects at a smaller distance are in contact
  std::vector<PathExtension> extensions_;
  std::vector<std::vector<Segment>> paths_;
  std::vector<bool> is_joined_;  ///< per fracture: whether the path ends on it
  int index_ = 0;                ///< of the extension that is checked
  std::optional<Obstacle> obstacle_;
};

}  // namespace

std::vector<PathExtension> check_extensions(const Mesh& mesh, const std::vector<PathExtension>& extensions,
                                            double size) {
  if (std::ranges::none_of(extensions, [](const PathExtension& extension) { return extension.replaced != 0; }))
    return Check(mesh, extensions, size).run();
  return Check(heal_ends(mesh, extensions).mesh, extensions, size).run();
}

bool comes_too_near(const Mesh& mesh, int fracture, const Point& beginning, const Point& from, const Point& to,
                    double size) {
  const Segment step{from, to};
  const auto is_near = [&](const Segment& other) {
    return distance(step, other) <
           std::min(room_ahead * least_gap * size, (1 + approach) / 2 * distance(beginning, other));
  };
  for (int face = 0; face < mesh.face_count(); ++face)
    if (mesh.face_side[face] != none && is_near(face_segment(mesh, face)) &&
        !leads_away(step, beginning, straight_side(mesh, face)))
      return true;
  for (int cell = 0; cell < mesh.fracture_cell_count(); ++cell)
    if (mesh.fracture_cells[cell].fracture != fracture && is_near(cell_segment(mesh, cell)) &&
        !leads_away(step, beginning, straight_part(mesh, cell)))
      return true;
  return false;
}

}  // namespace sprekk
