#include "framework/report/drawn_grid.hpp"

#include <Eigen/Geometry>
#include <algorithm>
#include <array>
#include <functional>
#include <map>

#include "framework/mesh/geometry.hpp"

namespace sprekk {
namespace {

/// What the viewer sees to the right and above, and how far it is away.
struct View {
  Point ahead = Point(0.45, 0.8, -0.4).normalized();
  Point right = ahead.cross(Point::UnitZ()).normalized();
  Point up = right.cross(ahead);
  std::array<double, 2> of(const Point& x) const { return {x.dot(right), x.dot(up)}; }
};

/// The smallest box along the axes that holds all points; that of no points is at the origin.
struct Box {
  Point low = Point::Zero(), high = Point::Zero();
  explicit Box(const std::vector<Point>& points) {
    if (!points.empty()) low = high = points.front();
    for (const Point& x : points) low = low.cwiseMin(x), high = high.cwiseMax(x);
  }
};

/// A face or an edge that one cell of the file has alone.
template <class Nodes>
struct Single {
  Nodes nodes;
  int cell;
};

/// Of all (nodes, cell) those whose nodes occur once, in the order of their nodes.
template <class Nodes>
std::vector<Single<Nodes>> singles(const std::vector<Single<Nodes>>& all) {
  std::map<std::vector<int>, std::vector<const Single<Nodes>*>> by_nodes;
  for (const Single<Nodes>& one : all) {
    std::vector<int> key(one.nodes.begin(), one.nodes.end());
    std::ranges::sort(key);
    by_nodes[key].push_back(&one);
  }
  std::vector<Single<Nodes>> found;
  for (const auto& [key, same] : by_nodes)
    if (same.size() == 1) found.push_back(*same.front());
  return found;
}

std::vector<Point> points_of(const GridData& read) {
  std::vector<Point> points;
  for (int i = 0; i < read.point_count(); ++i)
    points.emplace_back(read.points[3 * i], read.points[3 * i + 1], read.points[3 * i + 2]);
  return points;
}

template <class Nodes>
Nodes cell_of(const GridData& read, int cell) {
  Nodes nodes;
  for (auto k = cell == 0 ? 0 : read.cell_ends[cell - 1]; k < read.cell_ends[cell]; ++k)
    nodes.push_back(static_cast<int>(read.cell_points[k]));
  return nodes;
}

/// A face that is drawn, the ones on sides of the box before all others, and then the far ones first.
struct DrawnFace {
  Single<FaceNodes> face;
  bool is_inside;
  double depth;
  bool operator<(const DrawnFace& other) const {
    return is_inside != other.is_inside ? other.is_inside : depth > other.depth;
  }
};

std::vector<DrawnFace> drawn_faces(const GridData& read, const std::vector<Point>& points, const View& view) {
  std::vector<Single<FaceNodes>> all;
  for (int i = 0; i < read.cell_count(); ++i) {
    const auto cell = cell_of<CellNodes>(read, i);
    for (std::size_t k = 0; k < shape_with(cell.size())->faces.size(); ++k)
      all.push_back({nodes_of_face(cell, static_cast<int>(k)), i});
  }
  const Box box(points);
  const auto is_on_side = [&](const FaceNodes& face) {
    for (int axis = 0; axis < dimension; ++axis)
      for (const double at : {box.low[axis], box.high[axis]})
        if (std::all_of(face.begin(), face.end(), [&](int node) { return points[node][axis] == at; })) return true;
    return false;
  };
  std::vector<DrawnFace> drawn;
  for (const Single<FaceNodes>& face : singles(all)) {
    const FaceGeometry geometry = face_geometry(points, face.nodes);
    if (geometry.normal.dot(view.ahead) > 0)
      drawn.push_back({face, !is_on_side(face.nodes), geometry.center.dot(view.ahead)});
  }
  std::ranges::sort(drawn, std::less<>());
  return drawn;
}

}  // namespace

Grid drawn_grid(const std::filesystem::path& vtu) {
  const GridData read = read_whole(vtu);
  const std::vector<Point> points = points_of(read);
  const View view;
  Grid grid;
  for (const Point& x : points) grid.points.push_back(view.of(x));
  if (read.cell_dimension == dimension) {
    grid.points_per_cell = 3;
    for (const DrawnFace& drawn : drawn_faces(read, points, view))
      for (int k = 1; k + 1 < drawn.face.nodes.size(); ++k) {
        grid.cells.insert(grid.cells.end(), {drawn.face.nodes[0], drawn.face.nodes[k], drawn.face.nodes[k + 1]});
        grid.sources.push_back(drawn.face.cell);
      }
  } else {
    grid.points_per_cell = 2;
    std::vector<Single<RidgeNodes>> edges;
    for (int i = 0; i < read.cell_count(); ++i) {
      const auto face = cell_of<FaceNodes>(read, i);
      for (int k = 0; k < face.size(); ++k) edges.push_back({ridge_of(face, k), i});
    }
    for (const Single<RidgeNodes>& edge : singles(edges)) {
      grid.cells.insert(grid.cells.end(), {edge.nodes[0], edge.nodes[1]});
      grid.sources.push_back(edge.cell);
    }
  }
  add_arrays(read, grid);
  return grid;
}

std::vector<DrawnEdge> drawn_edges(const std::filesystem::path& vtu) {
  const Box box(points_of(read_whole(vtu)));
  const View view;
  std::vector<DrawnEdge> edges;
  // x and y along the bottom at the front and at the left, z at the left behind.
  for (int axis = 0; axis < dimension; ++axis) {
    Point from = box.low;
    if (axis == 2) from[1] = box.high[1];
    Point to = from;
    to[axis] = box.high[axis];
    edges.push_back({std::string(1, "xyz"[axis]), view.of(from), view.of(to), box.low[axis], box.high[axis]});
  }
  return edges;
}

}  // namespace sprekk
