#include "components/fine_fracture/quarter_point/mesh/outside_mesh.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "components/fine_fracture/fine_level/outline.hpp"
#include "framework/mesh/mesh.hpp"
#include "framework/round_off.hpp"
#include "framework/triangulation/canonical_drawing.hpp"
#include "framework/triangulation/mesh_region.hpp"
#include "framework/triangulation/smooth_triangles.hpp"

namespace sprekk::fine_fracture {
namespace {

/// Points and lines of the domain with holes for the rosettes, numbered from 0.
struct Drawing {
  std::vector<Point> points;
  std::vector<std::array<int, 2>> lines;
  std::vector<int> line_edges;  ///< the outline's edge that a line belongs to, or none; the outline's lines come first
  std::vector<std::vector<int>> rosette_points, rosette_lines;  ///< by tip
  std::vector<std::vector<int>> crack_lines;                    ///< along every crack

  int add_point(const Point& x) {
    points.push_back(x);
    return static_cast<int>(points.size()) - 1;
  }
  int add_line(int from, int to, int edge = none) {
    lines.push_back({from, to});
    line_edges.push_back(edge);
    return static_cast<int>(lines.size()) - 1;
  }
};

class DrawingBuilder {
 public:
  DrawingBuilder(const FineGeometry& geometry, const std::vector<TipRoom>& rooms, int sectors)
      : geometry_(geometry), rooms_(rooms), tolerance_(outline_tolerance(geometry.outline)) {
    draw_outline();
    for (const TipRoom& room : rooms_) draw_rosette(room, sectors);
    draw_junctions();
    for (std::size_t c = 0; c < geometry_.cracks.size(); ++c) draw_crack(static_cast<int>(c));
  }
  Drawing take() { return std::move(drawing_); }

 private:
  void draw_outline() {
    const auto& outline = geometry_.outline;
    for (std::size_t i = 0; i < outline.size(); ++i) {
      const Segment edge = outline_edge(outline, static_cast<int>(i));
      std::vector<std::pair<double, Point>> stops{{0.0, edge.from}};
      for (const CrackPath& crack : geometry_.cracks) {
        if (!crack.first_is_tip) add_stop(edge, crack.points.front(), stops);
        if (!crack.last_is_tip) add_stop(edge, crack.points.back(), stops);
      }
      std::sort(stops.begin(), stops.end(), [](const auto& a, const auto& b) { return a.first < b.first; });
      for (const auto& [along, x] : stops) {
        drawing_.add_point(x);
        outline_edges_.push_back(static_cast<int>(i));
      }
    }
    const int n = static_cast<int>(drawing_.points.size());
    for (int i = 0; i < n; ++i) drawing_.add_line(i, (i + 1) % n, outline_edges_[i]);
  }

  void add_stop(const Segment& edge, const Point& x, std::vector<std::pair<double, Point>>& stops) const {
    const double along = (x - edge.from).dot(edge.to - edge.from) / edge.length();
    const bool is_new = along > tolerance_ && along < edge.length() - tolerance_;
    if (is_new && distance(x, edge) <= 2 * tolerance_) stops.emplace_back(along, x);
  }

  void draw_rosette(const TipRoom& room, int sectors) {
    std::vector<int> points, lines;
    for (const Point& x : rosette_corners(room, sectors)) points.push_back(drawing_.add_point(x));
    for (int i = 0; i < sectors; ++i) lines.push_back(drawing_.add_line(points[i], points[(i + 1) % sectors]));
    drawing_.rosette_points.push_back(std::move(points));
    drawing_.rosette_lines.push_back(std::move(lines));
  }

  void draw_junctions() {
    for (const CrackPath& crack : geometry_.cracks) shared_points_.emplace_back(crack.points.size(), none);
    for (const CrackJunction& junction : junctions(geometry_)) {
      const int drawn = drawing_.add_point(junction.position);
      for (const auto& [crack, point] : junction.vertices) shared_points_[crack][point] = drawn;
    }
  }

  /// The point where the drawn part of a crack begins or ends.
  int end_point(int crack, bool is_last) const {
    for (std::size_t t = 0; t < rooms_.size(); ++t) {
      if (rooms_[t].crack == crack && rooms_[t].is_last == is_last) return drawing_.rosette_points[t][0];
    }
    const int shared = is_last ? shared_points_[crack].back() : shared_points_[crack].front();
    if (shared != none) return shared;
    const auto& path = geometry_.cracks[crack].points;
    const Point& x = is_last ? path.back() : path.front();
    const int n = static_cast<int>(outline_edges_.size());
    int nearest = 0;
    for (int i = 1; i < n; ++i) {
      if ((drawing_.points[i] - x).norm() < (drawing_.points[nearest] - x).norm()) nearest = i;
    }
    return nearest;
  }

  bool is_in_rosette(int crack, const Point& x) const {
    for (const TipRoom& room : rooms_) {
      if (room.crack == crack && (x - room.position).norm() <= room.radius * (1 + rounding::far_above)) return true;
    }
    return false;
  }

  void draw_crack(int c) {
    const auto& path = geometry_.cracks[c].points;
    std::vector<int> lines;
    int from = end_point(c, false);
    for (std::size_t i = 1; i + 1 < path.size(); ++i) {
      if (is_in_rosette(c, path[i])) continue;
      const int shared = shared_points_[c][i];
      const int to = shared != none ? shared : drawing_.add_point(path[i]);
      lines.push_back(drawing_.add_line(from, to));
      from = to;
    }
    lines.push_back(drawing_.add_line(from, end_point(c, true)));
    drawing_.crack_lines.push_back(std::move(lines));
  }

  const FineGeometry& geometry_;
  const std::vector<TipRoom>& rooms_;
  double tolerance_;
  std::vector<int> outline_edges_;               ///< by line of the outline
  std::vector<std::vector<int>> shared_points_;  ///< by crack and point of its path: drawn point, or none
  Drawing drawing_;
};

/// The region in the canonical frame of the drawing, so that mirrored domains get mirrored meshes.
RegionDrawing region(const Drawing& drawing, const CanonicalDrawing& canonical) {
  RegionDrawing region{canonical.points, std::vector<RegionDrawing::Line>(canonical.lines.size())};
  for (std::size_t i = 0; i < canonical.lines.size(); ++i) region.lines[i] = {canonical.lines[i], false, false};
  for (std::size_t i = 0; i < drawing.lines.size(); ++i)
    if (drawing.line_edges[i] != none) region.lines[canonical.line_number[i]].is_boundary = true;
  for (const auto& lines : drawing.rosette_lines) {
    for (const int line : lines) {
      RegionDrawing::Line& edge = region.lines[canonical.line_number[line]];
      edge.is_boundary = edge.is_whole = true;
    }
  }
  return region;
}

/// Maps points from the frame back to their positions.
class Reader {
 public:
  Reader(const Drawing& drawing, const CanonicalDrawing& canonical, const RegionMesh& mesh, RawMesh& raw)
      : drawing_(drawing), canonical_(canonical), mesh_(mesh) {
    for (const Point& x : mesh.points) raw.nodes.push_back(canonical.outward(x));
    raw.cells = mesh.triangles;
    for (std::size_t i = 0; i < drawing.points.size(); ++i)
      raw.nodes[at_point(static_cast<int>(i))] = drawing.points[i];  // without the rounding of the frame
  }

  int at_point(int point) const { return canonical_.point_number[point]; }

  /// The nodes of a line from its beginning to its end. Inner nodes are moved exactly onto the line.
  std::vector<int> along(int line, RawMesh& raw) const {
    std::vector<int> nodes = mesh_.on_line[canonical_.line_number[line]];
    if (canonical_.is_reversed[line]) std::reverse(nodes.begin(), nodes.end());
    const auto [a, b] = drawing_.lines[line];
    const Point from = drawing_.points[a], step = drawing_.points[b] - from;
    for (std::size_t i = 1; i + 1 < nodes.size(); ++i) {
      Point& x = raw.nodes[nodes[i]];
      x = from + (x - from).dot(step) / step.squaredNorm() * step;
    }
    return nodes;
  }

 private:
  const Drawing& drawing_;
  const CanonicalDrawing& canonical_;
  const RegionMesh& mesh_;
};

OutsideMesh read(const Drawing& drawing, const CanonicalDrawing& canonical, const RegionMesh& region,
                 int outline_edges) {
  OutsideMesh mesh;
  RawMesh& raw = mesh.raw;
  const Reader reader(drawing, canonical, region, raw);
  for (int i = 0; i < outline_edges; ++i) raw.side_names.push_back(std::to_string(i));
  for (std::size_t line = 0; line < drawing.lines.size(); ++line) {
    if (drawing.line_edges[line] == none) continue;
    const auto nodes = reader.along(static_cast<int>(line), raw);
    for (std::size_t i = 0; i + 1 < nodes.size(); ++i) {
      raw.boundary_faces.push_back({{nodes[i], nodes[i + 1]}, drawing.line_edges[line]});
    }
  }
  for (const auto& lines : drawing.crack_lines) {
    RawMesh::Chain chain{"", {}};
    for (const int line : lines) {
      const auto nodes = reader.along(line, raw);
      chain.nodes.insert(chain.nodes.end(), nodes.begin() + (chain.nodes.empty() ? 0 : 1), nodes.end());
    }
    raw.fractures.push_back(std::move(chain));
  }
  for (const auto& points : drawing.rosette_points) {
    std::vector<int> nodes;
    for (const int point : points) nodes.push_back(reader.at_point(point));
    mesh.rosettes.push_back(std::move(nodes));
  }
  return mesh;
}

}  // namespace

std::vector<Point> rosette_corners(const TipRoom& room, int sectors) {
  std::vector<Point> corners;
  const Point x1 = room.direction, x2(-x1.y(), x1.x());
  for (int k = 0; k < sectors; ++k) {
    const double angle = std::numbers::pi * (2.0 * k / sectors - 1);
    // The first corner lies exactly on the crack, without the rounding of the sine.
    const Point place = k == 0 ? Point(-1, 0) : Point(std::cos(angle), std::sin(angle));
    corners.push_back(room.position + room.radius * (place.x() * x1 + place.y() * x2));
  }
  return corners;
}

OutsideMesh mesh_outside(const FineGeometry& geometry, const std::vector<TipRoom>& rooms, int sectors,
                         const std::function<double(const Point&)>& size) {
  const Drawing drawing = DrawingBuilder(geometry, rooms, sectors).take();
  const CanonicalDrawing canonical(drawing.points, drawing.lines);
  // Lengths without the last digits, which differ between mirrored or shifted domains.
  RegionMesh mesh = mesh_region(region(drawing, canonical), [&](const Point& x) {
    return static_cast<double>(static_cast<float>(size(canonical.outward(x)) / canonical.scale()));
  });
  std::vector<char> is_free(mesh.points.size(), true);
  std::fill(is_free.begin(), is_free.begin() + mesh.first_inside, false);
  constexpr int rounds = 2;  // 0, 1 and 4 were tried, too
  smooth_triangles(mesh.points, mesh.triangles, is_free, rounds);
  return read(drawing, canonical, mesh, static_cast<int>(geometry.outline.size()));
}

}  // namespace sprekk::fine_fracture
