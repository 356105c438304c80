#include "components/fine_fracture/quarter_point/outside_mesh.hpp"

#include <gmsh.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <stdexcept>

#include "components/fine_fracture/quarter_point/outline.hpp"
#include "framework/mesh/cell_shape.hpp"
#include "framework/mesh/gmsh_drawing.hpp"
#include "framework/mesh/gmsh_model.hpp"
#include "framework/mesh/mesh.hpp"
#include "framework/mesh/smooth_triangles.hpp"

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

class Draughtsman {
 public:
  Draughtsman(const FineGeometry& geometry, const std::vector<TipRoom>& rooms, int sectors)
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
      if (room.crack == crack && (x - room.position).norm() <= room.radius * (1 + 1e-6)) return true;
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
  std::vector<std::vector<int>> shared_points_;  ///< by crack and point of its path: what is drawn, or none
  Drawing drawing_;
};

std::vector<int> outline_lines(const Drawing& drawing) {
  std::vector<int> lines;
  for (std::size_t i = 0; i < drawing.lines.size(); ++i)
    if (drawing.line_edges[i] != none) lines.push_back(static_cast<int>(i));
  return lines;
}

void enter(const Drawing& drawing, const CanonicalDrawing& canonical) {
  enter_drawing(canonical);
  std::vector<std::vector<int>> loops{outline_lines(drawing)};
  for (const auto& lines : drawing.rosette_lines) {
    for (const int line : lines) gmsh::model::geo::mesh::setTransfiniteCurve(canonical.line_number[line] + 1, 2);
    loops.push_back(lines);
  }
  std::vector<int> cracks;
  for (const auto& lines : drawing.crack_lines) cracks.insert(cracks.end(), lines.begin(), lines.end());
  add_surface(canonical, loops, cracks);
}

/// Reads the mesh that gmsh made.
class Reader {
 public:
  Reader(const Drawing& drawing, const CanonicalDrawing& canonical, RawMesh& raw)
      : drawing_(drawing), canonical_(canonical) {
    std::vector<std::size_t> tags, elements;
    std::vector<double> coordinates, parameters;
    gmsh::model::mesh::getNodes(tags, coordinates, parameters, -1, -1, false, false);
    number_.resize(tags.empty() ? 0 : *std::max_element(tags.begin(), tags.end()) + 1);
    for (std::size_t i = 0; i < tags.size(); ++i) {
      number_[tags[i]] = static_cast<int>(i);
      raw.nodes.emplace_back(coordinates[3 * i], coordinates[3 * i + 1]);
    }
    tags.clear();
    constexpr int three_node_triangle = 2;
    gmsh::model::mesh::getElementsByType(three_node_triangle, elements, tags);
    for (std::size_t i = 0; i + 2 < tags.size(); i += 3) {
      raw.cells.push_back({number_[tags[i]], number_[tags[i + 1]], number_[tags[i + 2]]});
      if (signed_area(raw.nodes, raw.cells.back()) < 0) raw.cells.back().turn();
    }
    smooth(raw);
    for (Point& x : raw.nodes) x = canonical.outward(x);
    for (std::size_t i = 0; i < drawing.points.size(); ++i) {
      tags.clear(), coordinates.clear(), parameters.clear();
      gmsh::model::mesh::getNodes(tags, coordinates, parameters, 0, canonical.point_number[i] + 1, false, false);
      points_.push_back(number_[tags.at(0)]);
      raw.nodes[points_.back()] = drawing.points[i];  // without the frame's rounding
    }
  }

  int at_point(int point) const { return points_[point]; }

  /// From the beginning of a line to its end. Nodes inside are placed on the line again.
  std::vector<int> along(int line, RawMesh& raw) const {
    std::vector<std::size_t> tags;
    std::vector<double> coordinates, parameters;
    gmsh::model::mesh::getNodes(tags, coordinates, parameters, 1, canonical_.line_number[line] + 1, false, false);
    const auto [a, b] = drawing_.lines[line];
    const Point from = drawing_.points[a], step = drawing_.points[b] - from;
    std::vector<std::pair<double, int>> ordered;
    for (const std::size_t tag : tags) {
      Point& x = raw.nodes[number_[tag]];
      const double t = (x - from).dot(step) / step.squaredNorm();
      x = from + t * step;
      ordered.emplace_back(t, number_[tag]);
    }
    std::sort(ordered.begin(), ordered.end());
    std::vector<int> nodes{points_[a]};
    for (const auto& [t, node] : ordered) nodes.push_back(node);
    nodes.push_back(points_[b]);
    return nodes;
  }

 private:
  /// In gmsh's frame, so that images of one another stay so.
  void smooth(RawMesh& raw) const {
    std::vector<std::size_t> tags;
    std::vector<double> coordinates, parameters;
    gmsh::model::mesh::getNodes(tags, coordinates, parameters, 2, -1, false, false);
    std::vector<char> is_free(raw.nodes.size(), false);
    for (const std::size_t tag : tags) is_free[number_[tag]] = true;
    constexpr int rounds = 2;
    smooth_triangles(raw.nodes, raw.cells, is_free, rounds);
  }

  const Drawing& drawing_;
  const CanonicalDrawing& canonical_;
  std::vector<int> number_;  ///< by gmsh's number
  std::vector<int> points_;  ///< nodes at the drawing's points
};

OutsideMesh read(const Drawing& drawing, const CanonicalDrawing& canonical, int outline_edges) {
  OutsideMesh mesh;
  RawMesh& raw = mesh.raw;
  const Reader reader(drawing, canonical, raw);
  for (int i = 0; i < outline_edges; ++i) raw.side_names.push_back(std::to_string(i));
  for (std::size_t line = 0; line < drawing.lines.size(); ++line) {
    if (drawing.line_edges[line] == none) continue;
    const auto nodes = reader.along(static_cast<int>(line), raw);
    for (std::size_t i = 0; i + 1 < nodes.size(); ++i) {
      raw.boundary_edges.push_back({{nodes[i], nodes[i + 1]}, drawing.line_edges[line]});
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
    // The first corner lies on the crack without rounding of its sine.
    const Point place = k == 0 ? Point(-1, 0) : Point(std::cos(angle), std::sin(angle));
    corners.push_back(room.position + room.radius * (place.x() * x1 + place.y() * x2));
  }
  return corners;
}

OutsideMesh mesh_outside(const FineGeometry& geometry, const std::vector<TipRoom>& rooms, int sectors,
                         const std::function<double(const Point&)>& size) {
  const Drawing drawing = Draughtsman(geometry, rooms, sectors).take();
  const CanonicalDrawing canonical(drawing.points, drawing.lines);
  OutsideMesh mesh;
  const GmshModel model;
  model.run("mesh the fine level", [&] {
    // Together a third of the price of gmsh's own choices. Shapes are smoothed afterwards, and lengths along a line are
    // needed for a number of edges.
    constexpr int delaunay = 5;
    gmsh::option::setNumber("Mesh.Algorithm", delaunay);
    gmsh::option::setNumber("Mesh.Smoothing", 0);
    gmsh::option::setNumber("Mesh.LcIntegrationPrecision", 1e-3);
    enter(drawing, canonical);
    // Without the last digits, in which images of one another differ.
    gmsh::model::mesh::setSizeCallback([&](int, int, double x, double y, double) {
      return static_cast<float>(size(canonical.outward({x, y})) / canonical.scale());
    });
    gmsh::model::mesh::generate(2);
    mesh = read(drawing, canonical, static_cast<int>(geometry.outline.size()));
  });
  if (mesh.raw.cells.empty()) throw std::runtime_error("gmsh made no triangles on the fine level");
  return mesh;
}

}  // namespace sprekk::fine_fracture
