#include "framework/meshing/unstructured_mesh.hpp"

#include <gmsh.h>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <map>

#include "framework/config/input_error.hpp"
#include "framework/mesh/cell_edges.hpp"
#include "framework/meshing/arrangement.hpp"
#include "framework/meshing/gmsh_model.hpp"
#include "framework/meshing/join_triangles.hpp"
#include "framework/meshing/regions.hpp"
#include "framework/meshing/size_field.hpp"

namespace sprekk {
namespace {

constexpr int box_segments = 4;

/// The box's outline first, counter-clockwise from the lower left corner; then the fractures, then the polygons.
std::vector<Segment> all_segments(const Geometry& geometry) {
  const auto [low, high] = std::pair(geometry.box.low, geometry.box.high);
  const Point corners[] = {low, {high.x(), low.y()}, high, {low.x(), high.y()}};
  std::vector<Segment> segments;
  for (int i = 0; i < box_segments; ++i) segments.push_back({corners[i], corners[(i + 1) % 4]});
  for (const FractureGeometry& fracture : geometry.fractures) {
    for (std::size_t i = 0; i + 1 < fracture.points.size(); ++i) {
      segments.push_back({fracture.points[i], fracture.points[i + 1]});
    }
  }
  for (const RegionGeometry& region : geometry.regions) {
    const auto& polygon = region.polygon;
    for (std::size_t i = 0; i < polygon.size(); ++i) {
      segments.push_back({polygon[i], polygon[(i + 1) % polygon.size()]});
    }
  }
  return segments;
}

/// gmsh meshes a box near the origin of size between 1 and 2: its absolute tolerances let it fail, and end the process,
/// for small boxes far away. The scale is a power of two, so that it costs no digits.
struct Frame {
  Point origin;
  double scale;

  explicit Frame(const Box& box) : origin(box.low), scale(std::exp2(std::floor(std::log2(box.size().maxCoeff())))) {}
  Point inward(const Point& x) const { return (x - origin) / scale; }
  Point outward(double x, double y) const { return origin + scale * Point(x, y); }
};

/// gmsh moves points by this share of the model's size, so that no four lie on a circle. With its default, 1e-9, it
/// folds triangles along a line that is oblique where the box is over 30,000 edges wide (measured: from 1e-9 at 5e4,
/// from 1e-10 at 3e5): the move has to be small against the square of an edge over the box.
double random_factor(const Geometry& geometry, const SizeField& sizes, const Arrangement& arrangement) {
  constexpr double standard = 1e-9, least = 1e-14;
  double edge = sizes.smallest();
  for (const auto& chain : arrangement.chains) {
    for (std::size_t i = 0; i + 1 < chain.size(); ++i) {
      edge = std::min(edge, (arrangement.points[chain[i + 1]] - arrangement.points[chain[i]]).norm());
    }
  }
  const double share = edge / geometry.box.size().maxCoeff();
  return std::clamp(0.1 * share * share, least, standard);
}

/// The curves between neighbouring points of an arrangement, numbered as gmsh knows them.
class Curves {
 public:
  Curves(const Arrangement& arrangement, const Frame& frame) : arrangement_(arrangement), frame_(frame) {
    for (std::size_t i = 0; i < arrangement.points.size(); ++i) {
      const Point x = frame.inward(arrangement.points[i]);
      gmsh::model::geo::addPoint(x.x(), x.y(), 0, 0, static_cast<int>(i) + 1);
    }
    std::vector<int> outline, inner;
    for (std::size_t s = 0; s < arrangement.chains.size(); ++s) {
      const auto& chain = arrangement.chains[s];
      for (std::size_t i = 0; i + 1 < chain.size(); ++i) {
        const auto key = std::minmax(chain[i], chain[i + 1]);
        if (tags_.count(key)) continue;
        const int tag = gmsh::model::geo::addLine(chain[i] + 1, chain[i + 1] + 1);
        tags_[key] = tag;
        (s < box_segments ? outline : inner).push_back(tag);
      }
    }
    const int loop = gmsh::model::geo::addCurveLoop(outline);
    const int surface = gmsh::model::geo::addPlaneSurface({loop});
    gmsh::model::geo::synchronize();
    if (!inner.empty()) gmsh::model::mesh::embed(1, inner, 2, surface);
  }

  /// gmsh's numbers of the nodes along a segment, from its beginning to its end, after meshing.
  std::vector<std::size_t> nodes_along(int segment) const {
    const auto& chain = arrangement_.chains[segment];
    std::vector<std::size_t> nodes;
    for (std::size_t i = 0; i + 1 < chain.size(); ++i) {
      std::vector<std::size_t> tags;
      std::vector<double> coordinates, parameters;
      gmsh::model::mesh::getNodes(tags, coordinates, parameters, 1, tags_.at(std::minmax(chain[i], chain[i + 1])), true,
                                  false);
      const Point from = arrangement_.points[chain[i]], along = arrangement_.points[chain[i + 1]] - from;
      std::vector<std::pair<double, std::size_t>> ordered;
      for (std::size_t n = 0; n < tags.size(); ++n) {
        const Point x = frame_.outward(coordinates[3 * n], coordinates[3 * n + 1]);
        ordered.emplace_back((x - from).dot(along), tags[n]);
      }
      std::sort(ordered.begin(), ordered.end());
      for (std::size_t n = i == 0 ? 0 : 1; n < ordered.size(); ++n) nodes.push_back(ordered[n].second);
    }
    return nodes;
  }

 private:
  const Arrangement& arrangement_;
  const Frame& frame_;
  std::map<std::pair<int, int>, int> tags_;  ///< by the numbers of the end points, smaller one first
};

/// gmsh's number of the node at a point of the arrangement.
std::size_t node_at(int point) {
  std::vector<std::size_t> tags;
  std::vector<double> coordinates, parameters;
  gmsh::model::mesh::getNodes(tags, coordinates, parameters, 0, point + 1, false, false);
  return tags.at(0);
}

void fetch_mesh(const Geometry& geometry, const Arrangement& arrangement, const Frame& frame, const Curves& curves,
                RawMesh& mesh) {
  std::vector<std::size_t> tags, elements;
  std::vector<double> coordinates, parameters;
  gmsh::model::mesh::getNodes(tags, coordinates, parameters, -1, -1, false, false);
  std::vector<int> number(tags.empty() ? 0 : *std::max_element(tags.begin(), tags.end()) + 1);
  for (std::size_t i = 0; i < tags.size(); ++i) {
    number[tags[i]] = static_cast<int>(i);
    mesh.nodes.push_back(frame.outward(coordinates[3 * i], coordinates[3 * i + 1]));
  }
  tags.clear();
  constexpr int three_node_triangle = 2;
  gmsh::model::mesh::getElementsByType(three_node_triangle, elements, tags);
  for (std::size_t i = 0; i + 2 < tags.size(); i += 3) {
    mesh.cells.push_back({number[tags[i]], number[tags[i + 1]], number[tags[i + 2]]});
  }

  mesh.side_names.assign(box_sides.begin(), box_sides.end());
  constexpr int side_of_segment[box_segments] = {2, 1, 3, 0};  // bottom, right, top, left
  for (int s = 0; s < box_segments; ++s) {
    const auto nodes = curves.nodes_along(s);
    for (std::size_t i = 0; i + 1 < nodes.size(); ++i) {
      mesh.boundary_edges.push_back({{number[nodes[i]], number[nodes[i + 1]]}, side_of_segment[s]});
    }
  }
  // The frame's rounding is taken back where a position was given.
  for (const auto& [nodes, side] : mesh.boundary_edges) {
    const int axis = side / 2;
    for (const int node : nodes) {
      mesh.nodes[node][axis] = side % 2 == 0 ? geometry.box.low[axis] : geometry.box.high[axis];
    }
  }
  for (std::size_t i = 0; i < arrangement.points.size(); ++i) {
    mesh.nodes[number[node_at(static_cast<int>(i))]] = arrangement.points[i];
  }
  int segment = box_segments;
  for (const FractureGeometry& fracture : geometry.fractures) {
    RawMesh::Chain chain{fracture.name, {}};
    for (std::size_t i = 0; i + 1 < fracture.points.size(); ++i) {
      const auto nodes = curves.nodes_along(segment++);
      for (std::size_t n = i == 0 ? 0 : 1; n < nodes.size(); ++n) chain.nodes.push_back(number[nodes[n]]);
    }
    mesh.fractures.push_back(std::move(chain));
  }
}

/// Sizes beyond what gmsh can do: measured with lines at all angles, it folds none up to 400,000 edges across a box.
void refuse_folds(const Geometry& geometry, const SizeField& sizes, const RawMesh& mesh) {
  try {
    const CellEdges edges(mesh.nodes, mesh.cells);
  } catch (const InputError& error) {
    char figures[128];
    std::snprintf(figures, sizeof figures, "edges of %.3g m in a box of %.3g m", sizes.smallest(),
                  geometry.box.size().maxCoeff());
    throw InputError(geometry.box.origin, "the mesh cannot be made", std::string(figures) + ": " + error.what(),
                     "choose a smaller box, or larger sizes, so that the box is at most 300,000 edges wide");
  }
}

}  // namespace

RawMesh unstructured_mesh(const Geometry& geometry, const MeshOptions& options) {
  const SizeField sizes(geometry, options);
  const Arrangement arrangement = arrange(all_segments(geometry), point_tolerance(geometry.box));
  RawMesh mesh;
  const GmshModel model;
  model.run("mesh the geometry", [&] {
    const Frame frame(geometry.box);
    const Curves curves(arrangement, frame);
    gmsh::model::mesh::setSizeCallback(
        [&](int, int, double x, double y, double) { return sizes.at(frame.outward(x, y)) / frame.scale; });
    gmsh::option::setNumber("Mesh.RandomFactor", random_factor(geometry, sizes, arrangement));
    gmsh::model::mesh::generate(2);
    fetch_mesh(geometry, arrangement, frame, curves, mesh);
  });
  refuse_folds(geometry, sizes, mesh);
  assign_regions(geometry, mesh);
  if (options.shape == MeshOptions::Shape::quadrilaterals) join_triangles(mesh);
  return mesh;
}

}  // namespace sprekk
