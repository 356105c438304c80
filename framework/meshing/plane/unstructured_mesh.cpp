#include "framework/meshing/unstructured_mesh.hpp"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <map>

#include "framework/config/input_error.hpp"
#include "framework/mesh/face_table.hpp"
#include "framework/meshing/gmsh_module/gmsh_module.hpp"
#include "framework/meshing/plane/arrangement.hpp"
#include "framework/meshing/plane/join_triangles.hpp"
#include "framework/meshing/plane/size_field.hpp"
#include "framework/meshing/regions.hpp"
#include "framework/module/module.hpp"

namespace sprekk {
namespace {

constexpr int box_segments = 4;

/// gmsh meshes a box near the origin of size between 1 and 2: with its absolute tolerances gmsh fails, and ends the
/// process, for small boxes far from the origin. The scale is a power of two, so that it costs no digits.
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
  // Gmsh's own; above round-off of its coordinates; as measured above.
  constexpr double standard = 1e-9, least = 1e-14, of_square = 0.1;
  double edge = sizes.smallest();
  for (const auto& chain : arrangement.chains) {
    for (std::size_t i = 0; i + 1 < chain.size(); ++i) {
      edge = std::min(edge, (arrangement.points[chain[i + 1]] - arrangement.points[chain[i]]).norm());
    }
  }
  const double share = edge / geometry.box.size().maxCoeff();
  return std::clamp(of_square * share * share, least, standard);
}

/// The lines between neighbouring points of an arrangement, as input of gmsh, and the nodes that gmsh makes along them.
class Lines {
 public:
  Lines(const Arrangement& arrangement, const Frame& frame) : arrangement_(arrangement), frame_(frame) {
    for (const Point& point : arrangement.points) {
      const Point x = frame.inward(point);
      given_.points.push_back({x.x(), x.y()});
    }
    for (std::size_t s = 0; s < arrangement.chains.size(); ++s) {
      const auto& chain = arrangement.chains[s];
      for (std::size_t i = 0; i + 1 < chain.size(); ++i) {
        const int line = static_cast<int>(given_.lines.size());
        if (!number_.emplace(std::minmax(chain[i], chain[i + 1]), line).second) continue;
        given_.lines.push_back({chain[i], chain[i + 1]});
        (s < box_segments ? given_.outline : given_.inner).push_back(line);
      }
    }
  }

  PlanarTriangles triangles(const SizeField& sizes, double random_factor) const {
    PlanarLines lines = given_;
    lines.size_at = [&](double x, double y) { return sizes.at(frame_.outward(x, y)) / frame_.scale; };
    lines.random_factor = random_factor;
    return module<GmshModule>("gmsh").triangles(lines);
  }

  /// The nodes along a segment, from its beginning to its end.
  std::vector<int> nodes_along(int segment, const PlanarTriangles& mesh) const {
    const auto& chain = arrangement_.chains[segment];
    std::vector<int> nodes;
    for (std::size_t i = 0; i + 1 < chain.size(); ++i) {
      const Point from = arrangement_.points[chain[i]], along = arrangement_.points[chain[i + 1]] - from;
      std::vector<std::pair<double, int>> ordered;
      for (const int node : mesh.line_nodes[number_.at(std::minmax(chain[i], chain[i + 1]))]) {
        const auto [x, y] = mesh.nodes[node];
        ordered.emplace_back((frame_.outward(x, y) - from).dot(along), node);
      }
      std::sort(ordered.begin(), ordered.end());
      for (std::size_t n = i == 0 ? 0 : 1; n < ordered.size(); ++n) nodes.push_back(ordered[n].second);
    }
    return nodes;
  }

 private:
  const Arrangement& arrangement_;
  const Frame& frame_;
  PlanarLines given_;
  std::map<std::pair<int, int>, int> number_;  ///< of a line, by the numbers of its end points, smaller one first
};

RawMesh raw_mesh(const Geometry& geometry, const Arrangement& arrangement, const Frame& frame, const Lines& lines,
                 const PlanarTriangles& made) {
  RawMesh mesh;
  for (const auto& [x, y] : made.nodes) mesh.nodes.push_back(frame.outward(x, y));
  for (const auto& [a, b, c] : made.triangles) mesh.cells.push_back({a, b, c});

  mesh.side_names.assign(box_sides.begin(), box_sides.end());
  constexpr int side_of_segment[box_segments] = {2, 1, 3, 0};  // bottom, right, top, left
  for (int s = 0; s < box_segments; ++s) {
    const auto nodes = lines.nodes_along(s, made);
    for (std::size_t i = 0; i + 1 < nodes.size(); ++i) {
      mesh.boundary_faces.push_back({{nodes[i], nodes[i + 1]}, side_of_segment[s]});
    }
  }
  // Nodes at given points get the exact positions of these points again, without the rounding of the frame.
  for (const auto& [nodes, side] : mesh.boundary_faces) {
    const int axis = side / 2;
    for (const int node : nodes) {
      mesh.nodes[node][axis] = side % 2 == 0 ? geometry.box.low[axis] : geometry.box.high[axis];
    }
  }
  for (std::size_t i = 0; i < arrangement.points.size(); ++i) mesh.nodes[made.point_nodes[i]] = arrangement.points[i];
  int segment = box_segments;
  for (const FractureGeometry& fracture : geometry.fractures) {
    RawMesh::Chain chain{fracture.name, {}};
    for (std::size_t i = 0; i + 1 < fracture.points.size(); ++i) {
      const auto nodes = lines.nodes_along(segment++, made);
      chain.nodes.insert(chain.nodes.end(), nodes.begin() + (i == 0 ? 0 : 1), nodes.end());
    }
    mesh.fractures.push_back(std::move(chain));
  }
  return mesh;
}

/// Refuses sizes at which gmsh folds triangles. Measured with lines at all angles: no fold with up to 400,000 edges
/// across a box.
void refuse_folds(const Geometry& geometry, const SizeField& sizes, const RawMesh& mesh) {
  try {
    const FaceTable edges(mesh.nodes, mesh.cells);
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
  const Frame frame(geometry.box);
  const Lines lines(arrangement, frame);
  const PlanarTriangles made = lines.triangles(sizes, random_factor(geometry, sizes, arrangement));
  RawMesh mesh = raw_mesh(geometry, arrangement, frame, lines, made);
  refuse_folds(geometry, sizes, mesh);
  assign_regions(geometry, mesh);
  if (options.shape == MeshOptions::Shape::quadrilaterals) join_triangles(mesh);
  return mesh;
}

}  // namespace sprekk
