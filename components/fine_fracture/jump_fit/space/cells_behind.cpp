#include "components/fine_fracture/jump_fit/space/cells_behind.hpp"

#include <Eigen/Geometry>
#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

#include "framework/round_off.hpp"

namespace sprekk::fine_fracture {

namespace {

Point ahead_of(const RimEdge& edge) { return edge.axes.col(0); }
Point left_of(const RimEdge& edge) { return edge.axes.col(1); }

bool is_corner(const RimEdge& one, const RimEdge& next) {
  constexpr double largest_bend = 0.79;  // rad, 45 degrees: circles of eight edges have none
  return one.axes.col(2).dot(next.axes.col(2)) < std::cos(largest_bend);
}

/// `count` edges of the front from `first` on. `start`: m, the arc length there.
FrontPiece piece_of(const Mesh& mesh, const FrontLine& front, int first, int count, double start) {
  FrontPiece piece{front.fracture, false, {}, {}, {start}, {}};
  const int all = static_cast<int>(front.edges.size());
  for (int i = 0; i < count; ++i) {
    const RimEdge& edge = front.edges[(first + i) % all];
    piece.ridges.push_back(front.ridges[(first + i) % all]);
    piece.edges.push_back(edge);
    piece.arc.push_back(piece.arc.back() + (mesh.nodes[edge.nodes[1]] - mesh.nodes[edge.nodes[0]]).norm());
  }
  return piece;
}

void add_directions(FrontPiece& piece) {
  for (int node = 0; node <= piece.count(); ++node) {
    const int before = piece.edge_at(node, -1), after = node < piece.count() ? node : piece.is_closed ? 0 : none;
    Point sum = Point::Zero();
    if (before != none) sum += ahead_of(piece.edges[before]);
    if (after != none) sum += ahead_of(piece.edges[after]);
    piece.ahead.push_back(sum.normalized());
  }
}

/// Fracture cells that are connected without crossing a junction have the same number.
std::vector<int> patches(const Mesh& mesh) {
  std::vector<int> patch(mesh.fracture_cell_count(), none);
  for (int first = 0; first < mesh.fracture_cell_count(); ++first) {
    if (patch[first] != none) continue;
    patch[first] = first;
    std::vector<int> waiting{first};
    while (!waiting.empty()) {
      const int cell = waiting.back();
      waiting.pop_back();
      for (const int ridge : mesh.fracture_cells[cell].ridges)
        for (const int other : mesh.ridges[ridge].cells)
          if (mesh.ridges[ridge].kind == Ridge::Kind::inside && patch[other] == none) {
            patch[other] = first;
            waiting.push_back(other);
          }
    }
  }
  return patch;
}

/// The nearest place on an edge: its distance and its share of the edge.
struct OnEdge {
  double distance, share;
};

OnEdge nearest_on(const Mesh& mesh, const RimEdge& edge, const Point& x) {
  const Point &from = mesh.nodes[edge.nodes[0]], along = mesh.nodes[edge.nodes[1]] - from;
  const double share = std::clamp((x - from).dot(along) / along.squaredNorm(), 0.0, 1.0);
  return {(x - from - share * along).norm(), share};
}

void see_from(const Mesh& mesh, const std::vector<FrontPiece>& pieces, int number, int k, const Point& x,
              CellBehind& seen) {
  const FrontPiece& piece = pieces[number];
  const OnEdge place = nearest_on(mesh, piece.edges[k], x);
  if (place.distance > (1 + rounding::far_above) * seen.distance ||
      (seen.piece == number && place.distance >= seen.distance))
    return;
  const bool is_as_far = place.distance >= (1 - rounding::far_above) * seen.distance;
  seen.is_between = is_as_far && (seen.is_between || seen.piece != number);
  const Point left = left_of(piece.edges[k]);
  Point ahead = (1 - place.share) * piece.ahead[k] + place.share * piece.ahead[k + 1];
  ahead = (ahead - ahead.dot(left) * left).normalized();
  seen.piece = number;
  seen.edge = k;
  seen.distance = place.distance;
  seen.arc = piece.arc[k] + place.share * piece.length(k);
  seen.axes << ahead, left, ahead.cross(left);
}

}  // namespace

double FrontPiece::way(double from, double to) const {
  const double straight = to - from;
  return is_closed ? std::remainder(straight, length()) : straight;
}

int FrontPiece::edge_at(int edge, int further) const {
  const int at = edge + further;
  if (is_closed) return (at % count() + count()) % count();
  return at < 0 || at >= count() ? none : at;
}

std::vector<FrontPiece> pieces_of_fronts(const Mesh& mesh) {
  std::vector<FrontPiece> pieces;
  for (const FrontLine& front : fronts(mesh)) {
    const int count = static_cast<int>(front.edges.size());
    std::vector<int> starts;
    for (int i = 0; i < count; ++i)
      if ((i == 0 && !front.is_closed) || is_corner(front.edges[(i + count - 1) % count], front.edges[i]))
        starts.push_back(i);
    const bool has_no_corner = starts.empty();
    if (has_no_corner) starts.push_back(0);
    double arc = 0;
    for (std::size_t s = 0; s < starts.size(); ++s) {
      const int end = s + 1 < starts.size() ? starts[s + 1] : front.is_closed ? starts.front() + count : count;
      pieces.push_back(piece_of(mesh, front, starts[s], end - starts[s], arc));
      pieces.back().is_closed = has_no_corner;
      add_directions(pieces.back());
      arc = pieces.back().arc.back();
    }
  }
  return pieces;
}

std::vector<CellBehind> cells_behind(const Mesh& mesh, const std::vector<FrontPiece>& pieces) {
  std::vector<CellBehind> seen(mesh.fracture_cell_count());
  const std::vector<int> patch = patches(mesh);
  for (int number = 0; number < static_cast<int>(pieces.size()); ++number) {
    const Fracture& fracture = mesh.fractures[pieces[number].fracture];
    for (int k = 0; k < pieces[number].count(); ++k)
      for (int cell = fracture.first_cell; cell < fracture.first_cell + fracture.cell_count; ++cell)
        if (patch[cell] == patch[pieces[number].edges[k].cell])
          see_from(mesh, pieces, number, k, mesh.fracture_cells[cell].center, seen[cell]);
  }
  for (CellBehind& cell : seen)
    if (cell.is_between) cell.piece = none;
  return seen;
}

std::vector<double> distances_in_cell(const Mesh& mesh, const FrontPiece& piece, const CellBehind& seen, int cell) {
  const FractureCell& home = mesh.fracture_cells[cell];
  const FaceNodes& nodes = mesh.face_nodes[home.faces[static_cast<int>(Wall::plus)]];
  // m along the front: edges beyond are not the nearest to any point of the cell.
  const double reach = seen.distance + 2 * home.size();
  std::vector<int> edges{seen.edge};
  for (const int direction : {-1, 1}) {
    double gone = 0;
    int k = piece.edge_at(seen.edge, direction);
    for (int steps = 1; k != none && steps < piece.count() && gone < reach; ++steps) {
      edges.push_back(k);
      gone += piece.length(k);
      k = piece.edge_at(k, direction);
    }
  }
  const auto distance = [&](const Point& x) {
    double least = std::numeric_limits<double>::infinity();
    for (const int k : edges) least = std::min(least, nearest_on(mesh, piece.edges[k], x).distance);
    return least;
  };
  // Each triangle is divided into sixteen of equal areas.
  constexpr int parts = 4;
  std::vector<double> distances;
  for (int corner = 2; corner < static_cast<int>(nodes.size()); ++corner) {
    const Point& from = mesh.nodes[nodes[0]];
    const Point one = (mesh.nodes[nodes[corner - 1]] - from) / (3 * parts),
                two = (mesh.nodes[nodes[corner]] - from) / (3 * parts);
    for (int i = 0; i < parts; ++i)
      for (int j = 0; i + j < parts; ++j) {
        distances.push_back(distance(from + (3 * i + 1) * one + (3 * j + 1) * two));
        if (i + j + 1 < parts) distances.push_back(distance(from + (3 * i + 2) * one + (3 * j + 2) * two));
      }
  }
  return distances;
}

double depth_behind(const Mesh& mesh, const RimEdge& edge) {
  double depth = 0;
  for (const int node : mesh.face_nodes[mesh.fracture_cells[edge.cell].faces[static_cast<int>(Wall::plus)]])
    depth = std::max(depth, ahead_of(edge).dot(mesh.nodes[edge.nodes[0]] - mesh.nodes[node]));
  return depth;
}

WayBehind way_behind(const Mesh& mesh, int fracture, int ridge, const RimEdge& edge) {
  const Point middle = mesh.ridges[ridge].center;
  WayBehind way{std::numeric_limits<double>::infinity(), false};
  const Fracture& own = mesh.fractures[fracture];
  for (int cell = own.first_cell; cell < own.first_cell + own.cell_count; ++cell)
    for (const int other : mesh.fracture_cells[cell].ridges) {
      const Ridge::Kind kind = mesh.ridges[other].kind;
      if (kind == Ridge::Kind::inside || other == ridge) continue;
      // Junctions have ridges between cells of other fractures, too, at the same place.
      const RimEdge end = rim_edge(mesh, other);
      std::array<double, 2> behind, along;
      for (int k = 0; k < 2; ++k) {
        const Point from_middle = mesh.nodes[end.nodes[k]] - middle;
        behind[k] = -ahead_of(edge).dot(from_middle);
        along[k] = edge.axes.col(2).dot(from_middle);
      }
      if ((along[0] <= 0) == (along[1] <= 0)) continue;
      const double length = behind[0] + (behind[1] - behind[0]) * along[0] / (along[0] - along[1]);
      if (length > 0 && length < way.length) way = {length, kind == Ridge::Kind::tip};
    }
  return way;
}

}  // namespace sprekk::fine_fracture
