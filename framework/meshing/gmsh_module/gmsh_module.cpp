#include "framework/meshing/gmsh_module/gmsh_module.hpp"

#include <gmsh.h>

#include <algorithm>
#include <cmath>
#include <numbers>

#include "framework/meshing/gmsh_module/gmsh_model.hpp"
#include "framework/module/define_module.hpp"

namespace sprekk {
namespace {

constexpr int three_node_triangle = 2, four_node_tetrahedron = 4;  // gmsh's numbers of types

/// gmsh numbers points, lines and nodes from 1.
int tag(int number) { return number + 1; }

std::vector<int> tags(const std::vector<int>& numbers) {
  std::vector<int> result;
  for (const int number : numbers) result.push_back(tag(number));
  return result;
}

void add_geometry(const PlanarLines& lines) {
  for (std::size_t i = 0; i < lines.points.size(); ++i)
    gmsh::model::geo::addPoint(lines.points[i][0], lines.points[i][1], 0, 0, tag(static_cast<int>(i)));
  for (std::size_t i = 0; i < lines.lines.size(); ++i)
    gmsh::model::geo::addLine(tag(lines.lines[i][0]), tag(lines.lines[i][1]), tag(static_cast<int>(i)));
  const int loop = gmsh::model::geo::addCurveLoop(tags(lines.outline));
  const int surface = gmsh::model::geo::addPlaneSurface({loop});
  gmsh::model::geo::synchronize();
  if (!lines.inner.empty()) gmsh::model::mesh::embed(1, tags(lines.inner), 2, surface);
}

/// The number of each node by its tag.
std::vector<int> fetch_nodes(std::vector<double>& coordinates) {
  std::vector<std::size_t> found;
  std::vector<double> parameters;
  gmsh::model::mesh::getNodes(found, coordinates, parameters, -1, -1, false, false);
  std::vector<int> number(found.empty() ? 0 : *std::max_element(found.begin(), found.end()) + 1);
  for (std::size_t i = 0; i < found.size(); ++i) number[found[i]] = static_cast<int>(i);
  return number;
}

PlanarTriangles fetch_mesh(const PlanarLines& lines) {
  PlanarTriangles mesh;
  std::vector<std::size_t> found, elements;
  std::vector<double> coordinates, parameters;
  const std::vector<int> number = fetch_nodes(coordinates);
  for (std::size_t i = 0; i < coordinates.size(); i += 3) mesh.nodes.push_back({coordinates[i], coordinates[i + 1]});
  gmsh::model::mesh::getElementsByType(three_node_triangle, elements, found);
  for (std::size_t i = 0; i + 2 < found.size(); i += 3)
    mesh.triangles.push_back({number[found[i]], number[found[i + 1]], number[found[i + 2]]});

  const auto nodes_of = [&](int dim, std::size_t entity) {
    std::vector<std::size_t> nodes;
    coordinates.clear();
    parameters.clear();
    gmsh::model::mesh::getNodes(nodes, coordinates, parameters, dim, tag(static_cast<int>(entity)), dim == 1, false);
    std::vector<int> numbers;
    for (const std::size_t node : nodes) numbers.push_back(number[node]);
    return numbers;
  };
  for (std::size_t i = 0; i < lines.lines.size(); ++i) mesh.line_nodes.push_back(nodes_of(1, i));
  for (std::size_t i = 0; i < lines.points.size(); ++i) mesh.point_nodes.push_back(nodes_of(0, i).at(0));
  return mesh;
}

using Vector = std::array<double, 3>;

Vector cross(const Vector& a, const Vector& b) {
  return {a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]};
}

double length(const Vector& a) { return std::hypot(a[0], a[1], a[2]); }

/// Adds an ellipse to OpenCASCADE's model; returns its tag.
int add_ellipse(const FlatSurface& surface) {
  namespace occ = gmsh::model::occ;
  const bool is_first = length(surface.one_axis) >= length(surface.other_axis);
  const Vector &longer = is_first ? surface.one_axis : surface.other_axis,
               &shorter = is_first ? surface.other_axis : surface.one_axis, &center = surface.center;
  // From the x-y plane by three turns: about z, so that its longer axis has the right place, then about y and z, so
  // that its normal has.
  const Vector normal = cross(longer, shorter);
  const double azimuth = std::atan2(normal[1], normal[0]),
               from_z = std::atan2(std::hypot(normal[0], normal[1]), normal[2]);
  const double along = std::cos(azimuth) * longer[0] + std::sin(azimuth) * longer[1];
  const double turn = std::atan2(std::cos(azimuth) * longer[1] - std::sin(azimuth) * longer[0],
                                 std::cos(from_z) * along - std::sin(from_z) * longer[2]);
  const int disk = occ::addDisk(0, 0, 0, length(longer), length(shorter));
  occ::rotate({{2, disk}}, 0, 0, 0, 0, 0, 1, turn);
  occ::rotate({{2, disk}}, 0, 0, 0, 0, 1, 0, from_z);
  occ::rotate({{2, disk}}, 0, 0, 0, 0, 0, 1, azimuth);
  occ::translate({{2, disk}}, center[0], center[1], center[2]);
  return disk;
}

/// Adds a surface to OpenCASCADE's model; returns its tag.
int add_surface(const FlatSurface& surface) {
  namespace occ = gmsh::model::occ;
  if (surface.corners.empty()) return add_ellipse(surface);
  std::vector<int> points, curves;
  for (const Vector& x : surface.corners) points.push_back(occ::addPoint(x[0], x[1], x[2]));
  for (std::size_t i = 0; i < points.size(); ++i)
    curves.push_back(occ::addLine(points[i], points[(i + 1) % points.size()]));
  return occ::addPlaneSurface({occ::addCurveLoop(curves)});
}

/// Adds the box, divided by the surfaces; returns the tags of the parts of each surface.
std::vector<std::vector<int>> add_geometry(const CutBox& box) {
  namespace occ = gmsh::model::occ;
  const int whole = occ::addBox(box.low[0], box.low[1], box.low[2], box.high[0] - box.low[0], box.high[1] - box.low[1],
                                box.high[2] - box.low[2]);
  gmsh::vectorpair tools, all;
  for (const FlatSurface& surface : box.surfaces) tools.emplace_back(2, add_surface(surface));
  std::vector<gmsh::vectorpair> parts;  // of the box, then of each surface
  if (!tools.empty()) occ::fragment({{3, whole}}, tools, all, parts);
  occ::synchronize();
  std::vector<std::vector<int>> tags(box.surfaces.size());
  for (std::size_t i = 0; i < box.surfaces.size(); ++i)
    for (const auto& [dim, part] : parts[i + 1])
      if (dim == 2) tags[i].push_back(part);
  return tags;
}

/// A place where edges have to be short.
struct Narrow {
  Vector at;
  double size;
};

Vector difference(const Vector& a, const Vector& b) { return {a[0] - b[0], a[1] - b[1], a[2] - b[2]}; }

double distance(const Vector& x, const Vector& from, const Vector& to) {
  const Vector along = difference(to, from), way = difference(x, from);
  const double square = along[0] * along[0] + along[1] * along[1] + along[2] * along[2];
  const double dot = along[0] * way[0] + along[1] * way[1] + along[2] * way[2];
  const double share = square > 0 ? std::clamp(dot / square, 0.0, 1.0) : 0;
  return length({way[0] - share * along[0], way[1] - share * along[1], way[2] - share * along[2]});
}

/// A curve of the model as a chain of segments.
struct Curve {
  int tag;
  std::vector<int> ends;
  std::vector<Vector> points;
  double curvature;  ///< the largest; 0 where it is straight
  Vector low, high;  ///< of its bounding box
  bool is_closed() const { return ends.front() == ends.back(); }
};

std::vector<Curve> all_curves() {
  constexpr int pieces = 16;  // fine for distances
  gmsh::vectorpair entities;
  gmsh::model::getEntities(entities, 1);
  std::vector<Curve> curves;
  for (const auto& [dim, tag] : entities) {
    gmsh::vectorpair ends;
    gmsh::model::getBoundary({{dim, tag}}, ends, false, false);
    std::vector<double> from, to, at, parameters, curvatures;
    gmsh::model::getParametrizationBounds(dim, tag, from, to);
    for (int k = 0; k <= pieces; ++k) parameters.push_back(from[0] + (to[0] - from[0]) * k / pieces);
    gmsh::model::getValue(dim, tag, parameters, at);
    std::string type;
    gmsh::model::getType(dim, tag, type);
    if (type != "Line") gmsh::model::getCurvature(dim, tag, parameters, curvatures);
    Curve curve{tag, {}, {}, curvatures.empty() ? 0 : *std::max_element(curvatures.begin(), curvatures.end()), {}, {}};
    for (const auto& [point, end] : ends) curve.ends.push_back(end);
    for (std::size_t i = 0; i + 2 < at.size(); i += 3) curve.points.push_back({at[i], at[i + 1], at[i + 2]});
    auto &low = curve.low, &high = curve.high;
    gmsh::model::getBoundingBox(dim, tag, low[0], low[1], low[2], high[0], high[1], high[2]);
    curves.push_back(std::move(curve));
  }
  return curves;
}

bool is_end(const Curve& curve, int point) {
  return std::find(curve.ends.begin(), curve.ends.end(), point) != curve.ends.end();
}

/// How near to point `tag` of the model, which is at x, a curve comes: its other end, where the point is an end of it.
double nearness(const Curve& curve, int tag, const Vector& x, double farthest) {
  Vector apart{};
  for (int k = 0; k < 3; ++k) apart[k] = std::max({curve.low[k] - x[k], x[k] - curve.high[k], 0.0});
  if (length(apart) >= farthest) return farthest;
  if (is_end(curve, tag))
    return curve.is_closed() ? farthest : length(difference(curve.points.front(), curve.points.back()));
  double nearest = farthest;
  if (curve.curvature > 0) {
    std::vector<double> closest, parameter;
    gmsh::model::getClosestPoint(1, curve.tag, {x[0], x[1], x[2]}, closest, parameter);
    return std::min(nearest, length(difference(x, {closest[0], closest[1], closest[2]})));
  }
  for (std::size_t k = 0; k + 1 < curve.points.size(); ++k)
    nearest = std::min(nearest, distance(x, curve.points[k], curve.points[k + 1]));
  return nearest;
}

/// How long edges at a point may be, if no edge of a bent curve may pass between it and the curve, or be all of the
/// curve. The middle of an edge of length h is at most h/2 away from its curve, and h^2 curvature/8 where h is small;
/// half of such a length leaves room for growth.
double clear_of_chords(const Curve& curve, int tag, const Vector& x, double wanted) {
  const bool at_end = is_end(curve, tag);
  const double near = nearness(curve, tag, x, at_end ? 2 * wanted : wanted);
  return std::min(wanted, at_end ? near / 2 : std::max(near, std::sqrt(near / curve.curvature)));
}

/// The points of the model that are nearer to others or to curves than edges are long.
std::vector<Narrow> narrow_places(const CutBox& box) {
  const std::vector<Curve> curves = all_curves();
  gmsh::vectorpair entities;
  gmsh::model::getEntities(entities, 0);
  std::vector<Narrow> narrow;
  for (const auto& [dim, tag] : entities) {
    std::vector<double> at;
    gmsh::model::getValue(dim, tag, {}, at);
    const Vector x{at[0], at[1], at[2]};
    const double wanted = box.size_at(x[0], x[1], x[2]);
    double size = wanted;
    if (double nearest = box.gap_edges * wanted; nearest > 0) {
      for (const Curve& curve : curves) nearest = std::min(nearest, nearness(curve, tag, x, nearest));
      size = std::min(size, std::max(nearest / box.gap_edges, box.least_size));
    }
    for (const Curve& curve : curves)
      if (curve.curvature > 0) size = clear_of_chords(curve, tag, x, size);
    if (size < wanted) narrow.push_back({x, size});
  }
  return narrow;
}

Tetrahedra fetch_mesh(const std::vector<std::vector<int>>& surfaces) {
  Tetrahedra mesh;
  std::vector<double> coordinates;
  const std::vector<int> number = fetch_nodes(coordinates);
  for (std::size_t i = 0; i < coordinates.size(); i += 3)
    mesh.nodes.push_back({coordinates[i], coordinates[i + 1], coordinates[i + 2]});
  std::vector<std::size_t> elements, nodes;
  gmsh::model::mesh::getElementsByType(four_node_tetrahedron, elements, nodes);
  for (std::size_t i = 0; i + 3 < nodes.size(); i += 4)
    mesh.tetrahedra.push_back({number[nodes[i]], number[nodes[i + 1]], number[nodes[i + 2]], number[nodes[i + 3]]});
  for (const std::vector<int>& parts : surfaces) {
    auto& triangles = mesh.triangles.emplace_back();
    for (const int part : parts) {
      elements.clear(), nodes.clear();  // gmsh appends
      gmsh::model::mesh::getElementsByType(three_node_triangle, elements, nodes, part);
      for (std::size_t i = 0; i + 2 < nodes.size(); i += 3)
        triangles.push_back({number[nodes[i]], number[nodes[i + 1]], number[nodes[i + 2]]});
    }
  }
  return mesh;
}

class Module final : public GmshModule {
 public:
  PlanarTriangles triangles(const PlanarLines& lines) const override {
    PlanarTriangles mesh;
    const GmshModel model;
    model.run("mesh the geometry", [&] {
      add_geometry(lines);
      gmsh::model::mesh::setSizeCallback([&](int, int, double x, double y, double) { return lines.size_at(x, y); });
      gmsh::option::setNumber("Mesh.RandomFactor", lines.random_factor);
      gmsh::model::mesh::generate(2);
      mesh = fetch_mesh(lines);
    });
    return mesh;
  }

  Tetrahedra tetrahedra(const CutBox& box) const override {
    Tetrahedra mesh;
    const GmshModel model;
    model.run("mesh the geometry", [&] {
      const std::vector<std::vector<int>> surfaces = add_geometry(box);
      const std::vector<Narrow> narrow = narrow_places(box);
      gmsh::model::mesh::setSizeCallback([&](int, int, double x, double y, double z) {
        double size = box.size_at(x, y, z);
        for (const Narrow& place : narrow)
          size = std::min(size, place.size + box.growth * length(difference({x, y, z}, place.at)));
        return size;
      });
      // Delaunay's. HXT (10) is ten times as fast, with equal angles, but its answers differ from run to run.
      gmsh::option::setNumber("Mesh.Algorithm3D", 1);
      gmsh::model::mesh::generate(3);
      mesh = fetch_mesh(surfaces);
    });
    return mesh;
  }
};

}  // namespace
}  // namespace sprekk

SPREKK_DEFINE_MODULE(sprekk::GmshModule, sprekk::Module)
